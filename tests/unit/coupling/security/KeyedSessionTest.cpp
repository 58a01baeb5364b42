// SPDX-License-Identifier: BSD-3-Clause
/// Who comes in with keys, and what the others are told.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "Faults.hpp"
#include "KeyFolder.hpp"
#include "OwnAddress.hpp"
#include "Pair.hpp"
#include "transport/Keys.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

/// A server that knows the client of the folder `keys`, and all that it logs.
class KeyedSession : public testing::Test
{
protected:
    ServerOptions server_with_keys(std::string const& endpoint)
    {
        ServerOptions options = server_options(endpoint);
        options.keys = keys.path();
        options.log = [this](std::string const& text)
        {
            std::lock_guard<std::mutex> const lock(mutex_);
            log_.push_back(text);
        };
        return options;
    }
    static ClientOptions client_of(std::filesystem::path const& folder, std::string const& endpoint)
    {
        ClientOptions options = client_options(endpoint);
        options.keys = folder;
        return options;
    }

    /// One step, and what the client received in it.
    static double run(Server& server, ClientOptions const& options)
    {
        auto client_side = in_background(
            [&]
            {
                Client client(options);
                client.connect({1.2, 1.8e-5});
                client.send_mesh(view_of(small_mesh()));
                FluidArrays const fluid(24, 1);
                double const received = client.begin_step(step(1), fluid.view()).void_fraction[3];
                client.end_step();
                client.finish("done");
                return received;
            });
        server.wait_for_client(server_terms());
        server.receive_mesh();
        server.accept_mesh(SolidArrays(24, 2).view());
        server.receive_fluid();
        server.send_solid(SolidArrays(24, 5).view(), {});
        server.receive_fluid();
        return client_side.get();
    }

    std::string log()
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        std::string all;
        for (std::string const& line : log_)
            all += line + "\n";
        return all;
    }

    KeyFolder keys;
    KeyFolder others;

private:
    std::mutex mutex_;
    std::vector<std::string> log_;
};

double constexpr answer = 1.0 / (1 + 5 + 3);  ///< of SolidArrays(24, 5) in cell 3

TEST_F(KeyedSession, RunsBetweenMachines)
{
    Server server(server_with_keys("tcp://" + own_address() + ":*"));
    EXPECT_EQ(run(server, client_of(keys.path(), server.endpoint())), answer);
    EXPECT_EQ(log(), "");
}

TEST_F(KeyedSession, RunsOverSocketFilesToo)
{
    Server server(server_with_keys(unused_ipc_endpoint()));
    EXPECT_EQ(run(server, client_of(keys.path(), server.endpoint())), answer);
}

TEST_F(KeyedSession, TurnsUnknownKeysAwayLogsThemAndGoesOn)
{
    std::filesystem::copy_file(keys / "server.public", others / "server.public",
                               std::filesystem::copy_options::overwrite_existing);
    Server server(server_with_keys("tcp://" + own_address() + ":*"));

    Client stranger(client_of(others.path(), server.endpoint()));
    EXPECT_FAULT(stranger.connect({1.2, 1.8e-5}), Fault::endpoint, "has turned us away (it does not know our key)");

    EXPECT_EQ(run(server, client_of(keys.path(), server.endpoint())), answer);
    std::string const key = transport::read_client_keys(others.path()).own.public_key;
    EXPECT_EQ(log(), "turned away a client at " + own_address() + " with the unknown key " + key + "\n");
}

TEST_F(KeyedSession, FailsInTimeForAnotherServersKey)
{
    std::filesystem::copy_file(others / "server.public", keys / "server.public",
                               std::filesystem::copy_options::overwrite_existing);
    Server server(server_with_keys(any_tcp_endpoint()));

    ClientOptions options = client_of(keys.path(), server.endpoint());
    options.connect_time = 0.5;
    Client client(options);
    EXPECT_FAULT(client.connect({1.2, 1.8e-5}), Fault::endpoint, "within 0.5 s");
    Client second(options);
    EXPECT_FAULT(second.connect({1.2, 1.8e-5}), Fault::endpoint, "the keys of the two sides do not fit");
    EXPECT_THAT(log(), testing::HasSubstr("another server's public key, and was closed"));
}

TEST_F(KeyedSession, NeedsThemOnBothSides)
{
    Server keyed(server_with_keys(any_tcp_endpoint()));
    ClientOptions plain = client_options(keyed.endpoint());
    plain.connect_time = 0.5;
    EXPECT_FAULT(Client(plain).connect({1.2, 1.8e-5}), Fault::endpoint, "or one has none");

    Server open(server_options(any_tcp_endpoint()));
    ClientOptions careful = client_of(keys.path(), open.endpoint());
    careful.connect_time = 0.5;
    EXPECT_FAULT(Client(careful).connect({1.2, 1.8e-5}), Fault::endpoint, "or one has none");
}

TEST_F(KeyedSession, IsRefusedWithoutKeysOffThisMachine)
{
    EXPECT_FAULT(Server(server_options("tcp://0.0.0.0:*")), Fault::endpoint, "./gimdem keys");
    Client client(client_options("tcp://192.0.2.1:5555"));
    EXPECT_FAULT(client.connect({1.2, 1.8e-5}), Fault::endpoint, "./gimdem keys");
}

}  // namespace
}  // namespace gimdem::test

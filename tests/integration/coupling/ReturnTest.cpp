// SPDX-License-Identifier: BSD-3-Clause
/// Clients that are lost and come back, and runs that go on from a checkpoint: to the bit as if nothing had happened.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <regex>

#include "Figure.hpp"
#include "ReturnScene.hpp"
#include "ScriptedMesh.hpp"
#include "ServerProcess.hpp"
#include "UniformFluid.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

double constexpr dt = return_dt;
int constexpr last = return_steps;
Mesh const mesh = scripted_mesh();
UniformFluid const fluid(static_cast<std::size_t>(mesh.cell_count), {0, 0, 1});

/// A client that goes on, or begins.
Client connect_once(std::string const& endpoint, std::optional<ResumePoint> const& resume)
{
    ClientOptions options = client_options(endpoint);
    options.wants.clear();  // as the scripted client
    options.resume = resume;
    Client client(std::move(options));
    client.connect(air);
    client.send_mesh(view_of(mesh));
    return client;
}

/// The same, again where the socket was just being closed: a server that has refused a client opens a new one.
Client connected(std::string const& endpoint, std::optional<ResumePoint> const& resume)
{
    for (int k = 0;; ++k)
        try
        {
            return connect_once(endpoint, resume);
        }
        catch (CouplingError const& error)
        {
            bool const broke = std::string(error.what()).find("said nothing of its state") != std::string::npos;
            if (!broke || k == 20) throw;
        }
}

/// Steps (from, to], where the session's steps count from `begin`; saves every 20th.
void run_steps(Client& client, int from, int to, int begin)
{
    for (int n = from + 1; n <= to; ++n)
    {
        client.begin_step({n - begin, dt * (n - 1), dt}, fluid.view());
        client.end_step();
        if (n % 20 == 0) client.save_checkpoint(dt * (n - 1) + dt, n - 20);
    }
}

void run_steps(Client& client, int from, int to)
{
    run_steps(client, from, to, from);
}

class Return : public testing::TestWithParam<char const*>
{
protected:
    /// A scripted client that is killed behind its first checkpoint, which is of step 20; returns that.
    ResumePoint lose_client(ServerProcess& server)
    {
        Process client({GIMDEM_SCRIPTED_CLIENT, server.endpoint(), "40", std::to_string(last), "", "20"},
                       folder / "client.txt");
        EXPECT_TRUE(client.wait_for_output("step 33\n", soon)) << client.output();
        client.signal(SIGKILL);
        client.wait(soon);
        std::string const told = client.output();
        std::smatch saved;
        EXPECT_TRUE(std::regex_search(told, saved, std::regex("saved step 20 of session (\\d+)"))) << told;
        EXPECT_TRUE(server.process().wait_for_output("for a client that goes on", soon));
        return {std::stoull(saved[1]), 20, 20 * dt};
    }

    TemporaryFolder folder;
};

INSTANTIATE_TEST_SUITE_P(Over, Return, testing::Values("ipc", "tcp"),
                         [](auto const& transport) { return std::string(transport.param); });

/// The run that nothing happens to.
struct Whole
{
    Whole()
    {
        ServerProcess server(unused_ipc_endpoint(), with_grace("0"));
        Client client = connected(server.endpoint(), {});
        run_steps(client, 0, last);
        client.finish("all steps done");
        server.expect_end(0, "");
        checkpoint = bytes_of(server.checkpoints().back());
        rows = bytes_of(server.result("bed.csv"));
    }

    std::string checkpoint, rows;
};

TEST_P(Return, OfALostClientEndsToTheBitAsIfItHadNeverLeft)
{
    Whole const whole;
    ServerProcess server(endpoint_over(GetParam()), with_grace("40"));
    ResumePoint const point = lose_client(server);

    auto const start = std::chrono::steady_clock::now();
    Client client = connected(server.endpoint(), point);
    figure("reconnect_time", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), "s");
    run_steps(client, 20, last);
    client.finish("all steps done");

    server.expect_end(0, "has come back");
    EXPECT_EQ(server.checkpoints().back().filename(), "step_000000060_at_0.006.h5");
    EXPECT_EQ(bytes_of(server.checkpoints().back()), whole.checkpoint);
    EXPECT_EQ(bytes_of(server.result("bed.csv")), whole.rows) << "rows behind the checkpoint must not come twice";
}

TEST_P(Return, IsForTheLostClientOnly)
{
    ServerProcess server(endpoint_over(GetParam()), with_grace("40"));
    ResumePoint const point = lose_client(server);
    auto const refusal = [&](std::optional<ResumePoint> const& resume)
    {
        try
        {
            connected(server.endpoint(), resume);
            return std::string("(welcome)");
        }
        catch (CouplingError const& error)
        {
            return std::string(error.what());
        }
    };

    EXPECT_THAT(refusal({}), testing::HasSubstr("this server waits for a client that goes on"));
    EXPECT_THAT(refusal(ResumePoint{point.session + 1, 20, 20 * dt}), testing::HasSubstr("it is not of this run"));
    EXPECT_THAT(refusal(ResumePoint{point.session, 21, 21 * dt}), testing::HasSubstr("no checkpoint of step 21"));
    Client client = connected(server.endpoint(), point);
    client.finish("enough");
    server.expect_end(0, "has come back");
}

TEST_P(Return, HasItsTime)
{
    ServerProcess server(endpoint_over(GetParam()), with_grace("0.5"));
    lose_client(server);
    server.expect_end(1, "has disappeared");
    EXPECT_THAT(server.process().output(), testing::HasSubstr("no client has come back"));
}

TEST(Restart, OfAServerWantsTheClientOfThePair)
{
    TemporaryFolder folder;
    ServerProcess first(unused_ipc_endpoint(), with_grace("0"));
    Client client = connected(first.endpoint(), {});
    run_steps(client, 0, 40);
    client.finish("enough");
    first.expect_end(0, "");
    ASSERT_EQ(first.checkpoints().size(), 2u);  // of steps 20 and 40; the end is no third one
    SmallCase settings = with_grace("0");
    settings.arguments = {"--restart", first.checkpoints().front()};

    ServerProcess second(unused_ipc_endpoint(), settings);
    EXPECT_THROW(connected(second.endpoint(), ResumePoint{1, 40, 40 * dt}), CouplingError);
    second.expect_end(1, "the client goes on from the checkpoint of step 40, the particles from that of step 20");

    ServerProcess third(unused_ipc_endpoint(), with_grace("0"));
    EXPECT_THROW(connected(third.endpoint(), ResumePoint{1, 40, 40 * dt}), CouplingError);
    third.expect_end(1, "this server begins a run");

    ServerProcess fourth(unused_ipc_endpoint(), settings);
    Client again = connected(fourth.endpoint(), ResumePoint{1, 20, 20 * dt});
    run_steps(again, 20, last);
    again.finish("all steps done");
    fourth.expect_end(0, "");
    EXPECT_EQ(bytes_of(fourth.checkpoints().back()), Whole().checkpoint);
}

TEST(FullDisk, EndsBothInOrderAndLeavesTheLastCheckpoint)
{
    ServerProcess server(unused_ipc_endpoint(), with_grace("0"));
    Client client = connected(server.endpoint(), {});
    run_steps(client, 0, 20);
    rlimit const small{50000, 50000};  // a checkpoint is larger, everything else is smaller [byte]
    ASSERT_EQ(::prlimit(server.process().id(), RLIMIT_FSIZE, &small, nullptr), 0);
    try
    {
        run_steps(client, 20, 40, 0);
        FAIL() << "the server has written a checkpoint";
    }
    catch (CouplingError const& error)
    {
        EXPECT_THAT(error.what(), testing::HasSubstr("step_000000040_at_0.004.h5 (File too large); free some space"));
    }
    server.expect_end(1, "step_000000040_at_0.004.h5 (File too large)");
    ASSERT_EQ(server.checkpoints().size(), 1u) << "half a file is left over";

    SmallCase settings = with_grace("0");
    settings.arguments = {"--restart", server.checkpoints().front()};
    ServerProcess next(unused_ipc_endpoint(), settings);
    Client again = connected(next.endpoint(), ResumePoint{1, 20, 20 * dt});
    run_steps(again, 20, last);
    again.finish("all steps done");
    next.expect_end(0, "");
    EXPECT_EQ(bytes_of(next.checkpoints().back()), Whole().checkpoint);
}

TEST(DeadPeer, IsDetectedWithinATenthOfTheTimeOut)
{
    TemporaryFolder folder;
    ServerProcess server(unused_ipc_endpoint(), with_grace("0", 2));
    Process client({GIMDEM_SCRIPTED_CLIENT, server.endpoint(), "40", "1000000000"}, folder / "client.txt");
    ASSERT_TRUE(client.wait_for_output("step 3\n", soon)) << client.output();
    client.signal(SIGSTOP);
    server.expect_end(1, "has been silent for", 2 + soon);

    std::string const told = server.process().output();
    std::smatch silence;
    ASSERT_TRUE(std::regex_search(told, silence, std::regex("has been silent for ([0-9.]+) s"))) << told;
    double const share = std::stod(silence[1]) / 2;
    figure("detection_of_dead_peer", share);  // of the time-out; a busy machine may notice later, never earlier
    EXPECT_GE(share, 0.9);
    EXPECT_LE(share, 2.0);
}

}  // namespace
}  // namespace gimdem::test

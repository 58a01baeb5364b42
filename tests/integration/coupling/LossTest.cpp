// SPDX-License-Identifier: BSD-3-Clause
/// Either process killed or stopped: the other ends in time, with the reasons, and leaves nothing behind.
#include <gtest/gtest.h>

#include "ServerProcess.hpp"
#include "SharedMemoryNames.hpp"
#include "UniformFluid.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

double constexpr timeout = 2;  ///< of the tests that wait for one [s]
double constexpr at_once = 4;  ///< below a fifth of `patient`, where a heartbeat would tell [s]
double constexpr dt = 1e-4;    ///< [s]
char const* const endless = "1000000000";

class Loss : public testing::TestWithParam<char const*>
{
protected:
    static SmallCase settings(double timeout_seconds)
    {
        SmallCase result;
        result.timeout = timeout_seconds;
        return result;
    }

    /// A client process in the middle of a run.
    void start_client(ServerProcess& server, std::string const& timeout_seconds)
    {
        client.emplace(std::vector<std::string>{GIMDEM_SCRIPTED_CLIENT, server.endpoint(), timeout_seconds, endless},
                       folder / "client.txt");
        ASSERT_TRUE(client->wait_for_output("step 3\n", soon)) << client->output();
    }

    /// Neither process has left a name in shared memory.
    void expect_no_shared_memory(ServerProcess& server) const
    {
        EXPECT_THAT(shared_memory_names(client->id()), testing::IsEmpty());
        EXPECT_THAT(shared_memory_names(server.process().id()), testing::IsEmpty());
    }

    /// Steps until the server is lost; returns why.
    static std::string step_until_lost(Client& client)
    {
        UniformFluid const fluid(static_cast<std::size_t>(SmallCase::mesh().cell_count), {0, 0, 1});
        try
        {
            for (int n = 1;; ++n)
            {
                client.begin_step({n, dt * (n - 1), dt}, fluid.view());
                client.end_step();
            }
        }
        catch (CouplingError const& error)
        {
            fault = error.fault();
            return error.what();
        }
    }

    static inline Fault fault = Fault::user;
    TemporaryFolder folder;
    std::optional<Process> client;
};

INSTANTIATE_TEST_SUITE_P(Over, Loss, testing::Values("ipc", "tcp"),
                         [](auto const& transport) { return std::string(transport.param); });

TEST_P(Loss, OfAKilledClientEndsTheServerAtOnce)
{
    ServerProcess server(endpoint_over(GetParam()), settings(patient));
    start_client(server, "40");
    client->signal(SIGKILL);
    server.expect_end(1, "client \"scripted client\" at ", at_once);
    EXPECT_THAT(server.process().output(), testing::HasSubstr("has disappeared"));
    EXPECT_EQ(server.checkpoints().size(), 1u) << "the last state was not kept";
    expect_no_shared_memory(server);
}

TEST_P(Loss, OfAStoppedClientEndsTheServerInTimeAndTheClientHearsWhy)
{
    ServerProcess server(endpoint_over(GetParam()), settings(timeout));
    start_client(server, "40");
    client->signal(SIGSTOP);
    server.expect_end(1, "has been silent for", timeout + soon);
    EXPECT_THAT(server.process().output(), testing::HasSubstr("(time-out 2 s"));

    client->signal(SIGCONT);
    EXPECT_EQ(client->wait(soon), 1) << client->output();
    EXPECT_THAT(client->output(), testing::HasSubstr("ended the run: client \"scripted client\""));
    EXPECT_THAT(client->output(), testing::HasSubstr("has been silent for"));
}

TEST_P(Loss, OfAKilledServerEndsTheClientAtOnce)
{
    std::string const endpoint = endpoint_over(GetParam());
    ServerProcess server(endpoint);
    start_client(server, "40");
    server.process().signal(SIGKILL);
    EXPECT_EQ(client->wait(at_once), 1) << client->output();
    EXPECT_THAT(client->output(), testing::HasSubstr("server \"gimdem-server"));
    EXPECT_THAT(client->output(), testing::HasSubstr("has disappeared"));
    EXPECT_EQ(server.process().wait(soon), 128 + SIGKILL);
    expect_no_shared_memory(server);

    // What the dead server left behind is in nobody's way.
    ServerProcess next(endpoint);
    Client second(client_options(next.endpoint()));
    second.connect(air);
    second.send_mesh(view_of(SmallCase::mesh()));
    second.finish("done");
    next.expect_end(0, "");
}

TEST_P(Loss, OfAStoppedServerEndsTheClientInTimeAndTheServerHearsWhy)
{
    ServerProcess server(endpoint_over(GetParam()));
    {
        Client own(client_options(server.endpoint(), timeout));
        own.connect(air);
        own.send_mesh(view_of(SmallCase::mesh()));
        server.process().signal(SIGSTOP);
        auto const start = std::chrono::steady_clock::now();
        std::string const why = step_until_lost(own);
        double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        EXPECT_EQ(fault, Fault::timeout);
        EXPECT_GT(seconds, timeout / 2);
        EXPECT_LT(seconds, timeout + soon);
        EXPECT_THAT(why, testing::HasSubstr("server \"gimdem-server"));
        EXPECT_THAT(why, testing::HasSubstr("has been silent for"));
        EXPECT_THAT(why, testing::HasSubstr("waiting for SolidState of step"));
    }
    server.process().signal(SIGCONT);
    server.expect_end(1, "client \"scripted client\" ended the run: server \"gimdem-server");
}

TEST_P(Loss, OfAClientThatStopsInAnOrderlyWayIsNoLoss)
{
    ServerProcess server(endpoint_over(GetParam()));
    Process orderly({GIMDEM_SCRIPTED_CLIENT, server.endpoint(), "40", "5"}, folder / "client.txt");
    EXPECT_EQ(orderly.wait(soon), 0) << orderly.output();
    server.expect_end(0, "");
}

TEST_P(Loss, OfAClientThatFailsTellsTheServerItsReason)
{
    ServerProcess server(endpoint_over(GetParam()));
    {
        Client failing(client_options(server.endpoint()));
        failing.connect(air);
        failing.send_mesh(view_of(SmallCase::mesh()));
        failing.abort("the pressure solver diverged");
    }
    server.expect_end(1, "ended the run: the pressure solver diverged");
}

TEST(LossAlone, OfPatienceWithoutAClientEndsTheServerAtOnce)
{
    ServerProcess server(unused_ipc_endpoint());
    server.process().signal(SIGINT);  // Ctrl-C
    EXPECT_EQ(server.process().wait(soon), 128 + SIGINT) << "it would wait for a client for longer";
}

TEST(LossAlone, OfNoClientAtAllEndsTheServer)
{
    SmallCase settings;
    settings.connect_time = 0.5;
    ServerProcess server(unused_ipc_endpoint(), settings);
    server.expect_end(1, "no client has appeared at ipc://");
}

}  // namespace
}  // namespace gimdem::test

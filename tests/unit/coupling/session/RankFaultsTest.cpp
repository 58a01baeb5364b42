// SPDX-License-Identifier: BSD-3-Clause
/// What ends one rank ends all, with the reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Faults.hpp"
#include "RankedPair.hpp"
#include "RawMessages.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;
using testing::AllOf;
using testing::AnyOf;
using testing::Each;
using testing::HasSubstr;
using testing::StartsWith;

class RankFault : public testing::Test
{
protected:
    void start(int ranks, ServerOptions const& options = server_options(unused_ipc_endpoint()))
    {
        server = std::make_unique<Server>(options);
        served = in_background([this] { return serve_ranks(*server); });
        client = std::make_unique<RankedClient>(server->endpoint(), ranks);
    }

    std::unique_ptr<Server> server;
    std::future<std::string> served;
    std::unique_ptr<RankedClient> client;
};

TEST_F(RankFault, ARankThatDoesNotComeIsNamed)
{
    ServerOptions options = server_options(unused_ipc_endpoint());
    options.connect_time = 1;
    start(3, options);

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            if (rank > 0) return;
            client->connect_first();
            client->clients[0].send_mesh(view_of(client->pieces.parts[0]));
        });

    EXPECT_THAT(served.get(), AllOf(StartsWith("timeout: no rank 1 of 3 has appeared")));
    EXPECT_THAT(words[0], AllOf(StartsWith("peer: "), HasSubstr("no rank 1 of 3 has appeared")));
}

TEST_F(RankFault, DifferentStepsAreRefused)
{
    start(2);
    client->connect_first();

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            client->begin(rank);
            Step own = step(1);
            own.dt *= rank == 1 ? 1 + 1e-15 : 1;
            client->clients[rank].begin_step(own, FluidArrays(client->cells(rank), 1).view());
        });

    EXPECT_THAT(served.get(), AllOf(StartsWith("protocol: "), HasSubstr("rank 0 sent step 1 at 0 s"),
                                    HasSubstr("rank 1 step 1"), HasSubstr("same steps")));
    EXPECT_THAT(words, Each(AllOf(StartsWith("peer: "), HasSubstr("must take the same steps"))));
}

TEST(RankFaultOfAnOldServer, IsThatItKnowsNoRanks)
{
    RawPeer server = RawPeer::server(unused_ipc_endpoint());
    auto greeted = in_background(
        [&]
        {
            server.receive();
            server.send(raw_welcome());  // as protocol 1.0 has it: without endpoints
            return server.receive_error();
        });
    {
        Client client(rank_options(server.endpoint(), 0, 2));
        EXPECT_FAULT(client.connect({1.2, 1.8e-5}), Fault::version, "told endpoints for 0 more ranks instead of 1");
    }
    EXPECT_THAT(greeted.get(), HasSubstr("update it, or run one process"));
}

TEST_F(RankFault, DifferentFieldsAreRefused)
{
    start(2);
    client->connect_first([](ClientOptions& options) { options.wants = {field::void_fraction}; });

    auto const words = client->on_all([&](std::size_t rank) { client->begin(rank); });

    EXPECT_THAT(served.get(), AllOf(StartsWith("protocol: "), HasSubstr("rank 1"), HasSubstr("differs from")));
    EXPECT_THAT(words, Each(HasSubstr("differs from that of rank 0")));
}

TEST_F(RankFault, DifferentFluidsAreRefused)
{
    start(2);
    client->connect_first();

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            if (rank == 1) client->clients[1].connect({1.3, 1.8e-5});
            client->clients[rank].send_mesh(view_of(client->pieces.parts[rank]));
        });

    EXPECT_THAT(served.get(), AllOf(StartsWith("protocol: "), HasSubstr("rank 1"), HasSubstr("differs from")));
    EXPECT_THAT(words, Each(HasSubstr("differs from that of rank 0")));
}

TEST_F(RankFault, ADeadRankEndsTheOthers)
{
    start(3);
    client->connect_first();

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            client->begin(rank);
            for (int n = 1; n <= 3; ++n)
            {
                if (rank == 1 && n == 3) return client->clients[rank].abort("out of memory");
                client->step_of(rank, n);
                client->clients[rank].end_step();
            }
        });

    EXPECT_THAT(served.get(), AllOf(StartsWith("peer: "), HasSubstr("rank 1 of 3"), HasSubstr("out of memory")));
    EXPECT_EQ(words[1], "(nothing)");
    EXPECT_THAT(words[0], AllOf(HasSubstr("rank 1 of 3"), HasSubstr("out of memory")));
    EXPECT_THAT(words[2], AllOf(HasSubstr("rank 1 of 3"), HasSubstr("out of memory")));
}

/// The server waits for rank 0, which waits for rank 1 in its own way and never speaks: the loss must be seen.
TEST_F(RankFault, IsSeenWhileTheServerWaitsForAnotherRank)
{
    start(2);
    client->connect_first();
    client->on_all([&](std::size_t rank) { client->begin(rank); });

    client->clients[1].abort("division by zero");

    EXPECT_THAT(served.get(), AllOf(HasSubstr("rank 1 of 2"), HasSubstr("division by zero")));
    EXPECT_FAULT(client->step_of(0, 1), Fault::peer, "division by zero");
}

/// The server may wait for such a client to come back, but not for one that said why it ends.
TEST_F(RankFault, IsALossIfTheRankSaysNothing)
{
    ServerOptions options = server_options(unused_ipc_endpoint());
    options.step_time = 0.5;  // rank 1 lives, and is as good as lost then
    start(2, options);
    client->connect_first();

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            client->begin(rank);
            if (rank == 0) client->step_of(0, 1);
        });

    EXPECT_THAT(served.get(), AllOf(StartsWith("timeout: "), HasSubstr("rank 1 of 2"), HasSubstr("has not sent")));
    EXPECT_THAT(words[0], AllOf(HasSubstr("rank 1 of 2"), HasSubstr("has not sent")));
    EXPECT_TRUE(server->has_lost_client());
}

TEST_F(RankFault, IsNoLossIfTheRankSaysWhy)
{
    start(2);
    client->connect_first();
    client->on_all([&](std::size_t rank) { client->begin(rank); });

    client->clients[1].abort("out of memory");

    EXPECT_THAT(served.get(), HasSubstr("out of memory"));
    EXPECT_FALSE(server->has_lost_client());
}

TEST_F(RankFault, DifferentCheckpointsAreRefused)
{
    start(2);
    client->connect_first([](ClientOptions& options) { options.resume = ResumePoint{7, 20, 0.5}; });

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            if (rank == 1) client->clients[1].connect({1.2, 1.8e-5});
            client->clients[rank].send_mesh(view_of(client->pieces.parts[rank]));
        });

    EXPECT_THAT(served.get(), AllOf(StartsWith("protocol: "), HasSubstr("rank 1"),
                                    HasSubstr("it goes on from step 20 of session 7 at 0.5 s, rank 0 begins a run")));
    EXPECT_THAT(words, Each(HasSubstr("start all ranks from one checkpoint")));
}

TEST_F(RankFault, AGoodbyeOfOneRankOnlyIsOutOfOrder)
{
    start(2);
    client->connect_first();

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            client->begin(rank);
            if (rank == 0) return client->clients[0].finish("done");
            client->step_of(1, 1);
        });

    EXPECT_THAT(served.get(), AllOf(StartsWith("protocol: "), HasSubstr("rank 0 said goodbye, but rank 1 began")));
    EXPECT_THAT(words[1], HasSubstr("rank 0 said goodbye"));
}

TEST_F(RankFault, ARankOfAnotherRunIsRefused)
{
    start(2);
    client->connect_first([](ClientOptions& options) { options.rank.run = run_number + 1; });

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            if (rank == 1) client->clients[1].connect({1.2, 1.8e-5});
            client->clients[rank].send_mesh(view_of(client->pieces.parts[rank]));
        });

    EXPECT_THAT(served.get(), AllOf(StartsWith("protocol: "), HasSubstr("rank 1 of 2"), HasSubstr("another run")));
    EXPECT_THAT(words, Each(HasSubstr("another run")));
}

TEST_F(RankFault, TwoRanksOfOneNumberAreRefused)
{
    start(3);
    client->connect_first([](ClientOptions& options) { options.rank.number = 1; });

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            if (rank > 0) client->clients[rank].connect({1.2, 1.8e-5});
            client->clients[rank].send_mesh(view_of(client->pieces.parts[rank]));
        });

    EXPECT_THAT(served.get(),
                AllOf(StartsWith("protocol: "), HasSubstr("rank 1 of 3"), HasSubstr("rank 2 of 3 is due")));
    EXPECT_THAT(words, Each(HasSubstr("rank 2 of 3 is due")));
}

TEST_F(RankFault, RankOneAtTheEndpointOfRankZeroIsRefused)
{
    start(2);
    Client wrong(rank_options(server->endpoint(), 1, 2));

    EXPECT_FAULT(wrong.connect({1.2, 1.8e-5}), Fault::peer, "rank 0 of 2 is due");

    EXPECT_THAT(served.get(), AllOf(StartsWith("protocol: "), HasSubstr("rank 0 of 2 is due")));
}

TEST_F(RankFault, MeshesThatDoNotMeetAreRefusedByName)
{
    start(2);
    client->connect_first();
    for (double& x : client->pieces.parts[1].points)
        x += 1e-3;

    auto const words = client->on_all([&](std::size_t rank) { client->begin(rank); });

    EXPECT_THAT(served.get(), AllOf(StartsWith("mesh: "), HasSubstr("procBoundary0to1"), HasSubstr("rank 1")));
    EXPECT_THAT(words, Each(AllOf(StartsWith("mesh: "), HasSubstr("procBoundary0to1"))));
}

TEST_F(RankFault, OfTheServerReachesEveryRank)
{
    server = std::make_unique<Server>(server_options(unused_ipc_endpoint()));
    served = in_background(
        [this]
        {
            server->wait_for_client(server_terms());
            auto const cells = static_cast<std::size_t>(server->receive_mesh().cell_count);
            server->accept_mesh(SolidArrays(cells, 0).view());
            server->receive_fluid();
            server->abort("a particle is not a number");
            return std::string();
        });
    client = std::make_unique<RankedClient>(server->endpoint(), 3);
    client->connect_first();

    auto const words = client->on_all(
        [&](std::size_t rank)
        {
            client->begin(rank);
            client->step_of(rank, 1);
        });

    EXPECT_THAT(words, Each(AllOf(StartsWith("peer: "), HasSubstr("a particle is not a number"))));
}

TEST(RankOptions, AreChecked)
{
    auto const make = [](Rank rank)
    {
        ClientOptions options = client_options("ipc:///nowhere");
        options.rank = rank;
        Client client(options);
    };
    EXPECT_FAULT(make({2, 2, 1}), Fault::user, "rank 2 of 2 (counted from 0)");
    EXPECT_FAULT(make({-1, 2, 1}), Fault::user, "rank -1 of 2");
    EXPECT_FAULT(make({0, max_ranks + 1, 1}), Fault::user, "33 ranks (1 to 32)");
    EXPECT_FAULT(make({0, 2, 0}), Fault::user, "without the run's number");
}

}  // namespace
}  // namespace gimdem::test

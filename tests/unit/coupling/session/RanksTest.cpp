// SPDX-License-Identifier: BSD-3-Clause
/// A client of several ranks is one client to the server's program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "RankedPair.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

struct Scheme
{
    std::string transport;
    Schedule schedule;
    int ranks;
    bool shared_memory;
};

class RankedRun : public testing::TestWithParam<Scheme>
{
};

std::vector<double> slice(std::vector<double> const& whole, std::size_t first, std::size_t count)
{
    return {whole.begin() + static_cast<std::ptrdiff_t>(first),
            whole.begin() + static_cast<std::ptrdiff_t>(first + count)};
}

int constexpr steps = 4;

/// What the server's program saw.
struct Seen
{
    ClientInfo client;
    Mesh mesh;
    std::vector<std::vector<double>> velocities;
    std::vector<FluidState> states;
};

Seen serve(Server& server, Schedule schedule)
{
    Seen seen;
    seen.client = server.wait_for_client(server_terms(schedule));
    seen.mesh = server.receive_mesh();
    auto const cells = static_cast<std::size_t>(seen.mesh.cell_count);
    server.accept_mesh(SolidArrays(cells, 0).view());
    while (auto fluid = server.receive_fluid())
    {
        seen.velocities.push_back(to_vector(fluid->fields.velocity));
        seen.states.push_back(*fluid);
        if (fluid->step.number == steps) server.request_stop("enough");
        server.send_solid(SolidArrays(cells, static_cast<double>(fluid->step.number)).view(), {});
    }
    return seen;
}

TEST_P(RankedRun, ExchangesEveryNumberOfEveryRank)
{
    auto const [transport, schedule, ranks, shared_memory] = GetParam();
    ServerOptions options = server_options(transport == "ipc" ? unused_ipc_endpoint() : any_tcp_endpoint());
    options.shared_memory = shared_memory;
    Server server(options);
    auto served = in_background([&, schedule = schedule] { return serve(server, schedule); });

    RankedClient client(server.endpoint(), ranks);
    client.connect_first();
    std::vector<std::size_t> first(1, 0);
    for (std::size_t rank = 0; rank < client.count(); ++rank)
        first.push_back(first.back() + client.cells(rank));
    std::array<std::vector<double>, steps> waiting;  // of each rank, when it began the step
    for (auto& of_ranks : waiting)
        of_ranks.resize(client.count());
    auto const words = client.on_all(
        [&, schedule = schedule](std::size_t rank)
        {
            client.begin(rank);
            for (int n = 1; n <= steps; ++n)
            {
                waiting[static_cast<std::size_t>(n - 1)][rank] = client.clients[rank].exchange_times().waiting;
                SolidFields const& solid = client.step_of(rank, n);
                SolidArrays const whole(first.back(), schedule == Schedule::serial ? n : n - 1);
                std::size_t const cells = client.cells(rank);
                EXPECT_EQ(to_vector(solid.void_fraction), slice(whole.void_fraction, first[rank], cells));
                EXPECT_EQ(to_vector(solid.drag_momentum), slice(whole.drag_momentum, 3 * first[rank], 3 * cells));
                client.clients[rank].end_step({rank == 1 ? 0.5 : 0.25, rank == 1 ? 0.125 : 0, 0.0625});
            }
            EXPECT_EQ(client.clients[rank].stop_request(), "enough");
            client.clients[rank].finish("done");
        });
    Seen const seen = served.get();

    EXPECT_THAT(words, testing::Each("(nothing)"));
    EXPECT_EQ(seen.client.ranks, ranks);
    EXPECT_EQ(seen.client.name, "test client 1");
    EXPECT_EQ(seen.mesh.neighbour.size(), small_mesh().neighbour.size());
    ASSERT_EQ(seen.states.size(), std::size_t{steps});
    for (int n = 1; n <= steps; ++n)
    {
        auto const& state = seen.states[static_cast<std::size_t>(n - 1)];
        std::vector<double> expected;
        for (std::size_t rank = 0; rank < client.count(); ++rank)
        {
            auto const part = FluidArrays(client.cells(rank), 100.0 * static_cast<double>(rank) + n).velocity;
            expected.insert(expected.end(), part.begin(), part.end());
        }
        EXPECT_EQ(seen.velocities[static_cast<std::size_t>(n - 1)], expected);
        EXPECT_EQ(state.step.number, n);
        ASSERT_EQ(state.monitors.size(), 1u);
        EXPECT_EQ(state.monitors[0].value, 0) << "monitors are those of rank 0";
        EXPECT_EQ(state.previous.compute, n == 1 ? 0 : 0.5) << "the slowest rank's";
        EXPECT_EQ(state.previous.mapping, n == 1 ? 0 : 0.125);
        EXPECT_EQ(state.waiting, *std::ranges::max_element(waiting[static_cast<std::size_t>(n - 1)])) << "the longest";
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, RankedRun,
                         testing::Values(Scheme{"ipc", Schedule::serial, 2, true},
                                         Scheme{"ipc", Schedule::overlapped, 3, true},
                                         Scheme{"ipc", Schedule::serial, 3, false},
                                         Scheme{"tcp", Schedule::overlapped, 2, false}));

/// A mesh large enough for its fields to lie in shared memory: each rank has a segment and a mailbox of its own.
TEST(Ranks, UseSharedMemory)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server, Schedule::serial); });
    RankedClient client(server.endpoint(), 2);
    Mesh const large = BoxMesh::make({8, 8, 16}, {1, 1, 2});
    client.pieces = cut(large, dealt(large.cell_count, 2, 512));
    client.connect_first();

    auto const words = client.on_all(
        [&](std::size_t rank)
        {
            client.begin(rank);
            for (int n = 1; n <= steps; ++n)
            {
                auto const solid = to_vector(client.step_of(rank, n).drag_coefficient);
                EXPECT_EQ(solid, slice(SolidArrays(1024, n).drag_coefficient, 512 * rank, 512)) << rank;
                client.clients[rank].end_step();
            }
            client.clients[rank].finish("done");
        });
    Seen const seen = served.get();

    EXPECT_THAT(words, testing::Each("(nothing)"));
    ASSERT_EQ(seen.velocities.size(), std::size_t{steps});
    EXPECT_EQ(slice(seen.velocities.back(), 3 * 512, 3 * 512), FluidArrays(512, 100 + steps).velocity);
    EXPECT_EQ(server.shared_memory_note(), "");
}

TEST(Ranks, RankZeroHasTheServerSaveForAll)
{
    Server server(server_options(unused_ipc_endpoint()));
    std::vector<double> saved;
    server.save_checkpoints_by(
        [&](CheckpointRequest const& request)
        {
            saved.push_back(request.time);
            return SavedCheckpoint{.session = 0, .step = 1, .time = request.time, .name = "first"};
        });
    auto served = in_background([&] { return serve(server, Schedule::serial); });
    RankedClient client(server.endpoint(), 2);
    client.connect_first();

    auto const words = client.on_all(
        [&](std::size_t rank)
        {
            client.begin(rank);
            client.step_of(rank, 1);
            client.clients[rank].end_step();
            EXPECT_EQ(client.clients[rank].welcome().saves_checkpoints, rank == 0);
            if (rank == 0)
            {
                EXPECT_EQ(client.clients[0].save_checkpoint(1e-3, 0).name, "first");
            }
            client.step_of(rank, 2);
            client.clients[rank].end_step();
            client.clients[rank].finish("done");
        });
    served.get();

    EXPECT_THAT(words, testing::Each("(nothing)"));
    EXPECT_EQ(saved, std::vector<double>{1e-3});
}

TEST(Ranks, AMistakeInTheSolidReachesNoRank)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background(
        [&]
        {
            server.wait_for_client(server_terms());
            auto const cells = static_cast<std::size_t>(server.receive_mesh().cell_count);
            server.accept_mesh(SolidArrays(cells, 0).view());
            server.receive_fluid();
            SolidArrays solid(cells, 1);
            solid.drag_coefficient.back() = std::nan("");
            EXPECT_FAULT(server.send_solid(solid.view(), {}), Fault::user,
                         "\"drag_coefficient\" has nan in cell " + std::to_string(cells - 1));
            server.send_solid(SolidArrays(cells, 1).view(), {});
            EXPECT_FALSE(server.receive_fluid());
        });
    RankedClient client(server.endpoint(), 2);
    client.connect_first();

    auto const words = client.on_all(
        [&](std::size_t rank)
        {
            client.begin(rank);
            EXPECT_EQ(client.step_of(rank, 1).void_fraction.size(), client.cells(rank));
            client.clients[rank].end_step();
            client.clients[rank].finish("done");
        });
    served.get();

    EXPECT_THAT(words, testing::Each("(nothing)"));
}

}  // namespace
}  // namespace gimdem::test

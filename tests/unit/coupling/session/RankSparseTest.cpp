// SPDX-License-Identifier: BSD-3-Clause
/// Only some cells travel to and from the ranks of a client.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "RankedPair.hpp"
#include "SparseSolid.hpp"
#include "session/RankCells.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

int constexpr steps = 9, ranks = 3;
std::size_t constexpr cells = 2000;

/// Uneven parts, of 720, 660 and 620 cells.
MeshParts parts()
{
    Mesh const mesh = BoxMesh::make({10, 10, 20}, {0.1, 0.1, 0.2});
    std::vector<int> rank_of = dealt(mesh.cell_count, ranks, 80);
    std::fill_n(rank_of.begin() + 1100, 40, 0);
    return cut(mesh, rank_of);
}

/// Numbered rank by rank: most of rank 0, in later steps some of rank 1, of rank 2 a stray cell.
CellRuns bed(int n)
{
    return {{0, 500 + 40 * n}, {1500 + n, 1}};
}

bool is_in_bed(int n, std::size_t c)
{
    return c < 500 + 40 * static_cast<std::size_t>(n) || c == 1500 + static_cast<std::size_t>(n);
}

SolidArrays solid(int n)
{
    return solid_in(bed(n), cells, n);
}

struct Seen
{
    std::vector<std::vector<double>> velocities;  ///< of all cells
    int incomplete = 0;                           ///< fluids that lacked cells
    double bytes = 0;
};

/// Needs the velocity in the bed of the step before; in every third step it finds that this was not enough. In later
/// steps rank 0 sends all its cells, the others do not.
Seen serve(Server& server, Schedule schedule)
{
    Seen seen;
    server.wait_for_client(server_terms(schedule));
    server.receive_mesh();
    auto const cells_of = [](int n) {
        return StepCells{bed(n), {{{field::velocity}, bed(n)}, {{field::pressure_gradient}, {{0, 800}}}}};
    };
    server.accept_mesh(solid(0).view(), {}, cells_of(0));
    double const before = server.bytes();
    while (auto fluid = server.receive_fluid())
    {
        int const n = static_cast<int>(fluid->step.number);
        seen.incomplete += !fluid->is_complete;
        if (n % 3 == 0 && schedule == Schedule::serial)
        {
            server.complete(*fluid);
            EXPECT_TRUE(fluid->is_complete);
            server.complete(*fluid);  // costs nothing the second time
        }
        seen.velocities.push_back(to_vector(fluid->fields.velocity));
        server.send_solid(solid(n).view(), {}, cells_of(n));
    }
    seen.bytes = (server.bytes() - before) / steps;
    return seen;
}

bool same_bits(Span<double const> part, double const* whole)
{
    return std::memcmp(part.data(), whole, part.size() * sizeof(double)) == 0;
}

/// Ranks from `can` on cannot do it, as clients of protocol 1.0.
struct Way
{
    std::string transport;
    bool shared_memory;
    Schedule schedule;
    int can;
};

class RankedSparseRun : public testing::TestWithParam<Way>
{
};

TEST_P(RankedSparseRun, GivesEveryCellItsNumbersAndTheOthersNone)
{
    Way const way = GetParam();
    ServerOptions options = server_options(way.transport == "ipc" ? unused_ipc_endpoint() : any_tcp_endpoint());
    options.shared_memory = way.shared_memory;
    Server server(options);
    auto served = in_background([&] { return serve(server, way.schedule); });
    ClientOptions first = rank_options(server.endpoint(), 0, ranks);
    first.encodings = {way.can > 0, false, false};
    RankedClient client(first, parts());
    client.connect_first([&](ClientOptions& own) { own.encodings = {own.rank.number < way.can, false, false}; });
    std::size_t const first_cell[ranks + 1]{0, client.cells(0), client.cells(0) + client.cells(1), cells};

    auto const words = client.on_all(
        [&](std::size_t rank)
        {
            client.begin(rank);
            EXPECT_EQ(client.clients[rank].welcome().encodings.sparse, static_cast<int>(rank) < way.can);
            for (int n = 1; n <= steps; ++n)
            {
                FluidArrays const fluid(client.cells(rank), 1e4 * static_cast<double>(rank) + n);
                SolidFields const& got = client.clients[rank].begin_step(step(n), fluid.view());
                SolidArrays const expected = solid(way.schedule == Schedule::serial ? n : n - 1);
                std::size_t const c = first_cell[rank];
                ASSERT_EQ(got.void_fraction.size(), client.cells(rank));
                EXPECT_TRUE(same_bits(got.void_fraction, &expected.void_fraction[c])) << "step " << n;
                EXPECT_TRUE(same_bits(got.drag_coefficient, &expected.drag_coefficient[c])) << "step " << n;
                EXPECT_TRUE(same_bits(got.drag_momentum, &expected.drag_momentum[3 * c])) << "step " << n;
                client.clients[rank].end_step();
            }
            client.clients[rank].finish("done");
        });
    Seen const seen = served.get();

    EXPECT_THAT(words, testing::Each("(nothing)"));
    EXPECT_EQ(seen.incomplete, way.can > 0 ? steps : 0);
    ASSERT_EQ(seen.velocities.size(), std::size_t{steps});
    for (int n = 1; n <= steps; ++n)
    {
        std::vector<double> const& velocity = seen.velocities[static_cast<std::size_t>(n - 1)];
        bool const all = n % 3 == 0 && way.schedule == Schedule::serial;
        std::size_t absent = 0, wrong = 0;
        for (std::size_t rank = 0, c = 0; rank < ranks; ++rank)
        {
            FluidArrays const fluid(client.cells(rank), 1e4 * static_cast<double>(rank) + n);
            for (std::size_t own = 0; own < client.cells(rank); ++own, ++c)
            {
                bool const is_right = std::memcmp(&velocity[3 * c], &fluid.velocity[3 * own], 3 * sizeof(double)) == 0;
                bool const is_absent = velocity[3 * c] == 0 && velocity[3 * c + 1] == 0 && velocity[3 * c + 2] == 0;
                bool const may_be_absent = !all && static_cast<int>(rank) < way.can && !is_in_bed(n - 1, c);
                wrong += !is_right && !(is_absent && may_be_absent);
                absent += !is_right;
            }
        }
        EXPECT_EQ(wrong, 0u) << "step " << n;
        // Ranks 1 and 2 have little of the bed; rank 0 sends all its cells where it has most of them.
        EXPECT_EQ(absent > 900, !all && way.can == ranks) << "step " << n;
    }
    double constexpr whole_bytes = (6 + 5) * 8.0 * cells;
    double constexpr bed_bytes = (3 + 5) * 8.0 * 501;  // at least: of the first bed, velocity and solid
    EXPECT_GT(seen.bytes, way.can == 0 ? whole_bytes : bed_bytes);
    // Of rank 1's 660 cells 140 are in the bed at most: 520 leave out 5 numbers of the solid, and in two of three steps
    // 3 of the velocity and 3 of the gradient. That is 22 %, of which 2 % are left to envelopes.
    EXPECT_LT(seen.bytes, way.can == 0 ? 1.1 * whole_bytes : 0.8 * whole_bytes);
}

INSTANTIATE_TEST_SUITE_P(Ways, RankedSparseRun,
                         testing::Values(Way{"ipc", true, Schedule::serial, ranks},
                                         Way{"ipc", true, Schedule::overlapped, ranks},
                                         Way{"ipc", false, Schedule::serial, ranks},
                                         Way{"tcp", false, Schedule::overlapped, ranks},
                                         Way{"ipc", true, Schedule::serial, 2}, Way{"tcp", false, Schedule::serial, 0}),
                         [](auto const& way)
                         {
                             return way.param.transport + (way.param.shared_memory ? "_shared_" : "_plain_") +
                                    (way.param.schedule == Schedule::serial ? "serial_" : "overlapped_") +
                                    std::to_string(way.param.can) + "_can";
                         });

/// The cells of a list, one by one.
std::vector<std::int32_t> listed(CellRuns const& runs, std::int32_t shift)
{
    std::vector<std::int32_t> all;
    for (CellRun const& run : runs)
        for (std::int32_t k = 0; k < run.count; ++k)
            all.push_back(run.first + k + shift);
    return all;
}

TEST(RankCells, CutRunsWithoutLosingOrAddingACell)
{
    std::vector<std::int32_t> const first_cell{0, 5, 5, 9, 20};  // rank 1 has none
    session::RankCells const dealt_cells(first_cell, {});
    for (CellRuns const& whole :
         std::vector<CellRuns>{{}, {{0, 20}}, {{4, 1}}, {{5, 4}}, {{4, 2}, {8, 1}}, {{1, 2}, {4, 6}, {12, 1}, {19, 1}}})
    {
        std::vector<std::int32_t> found;
        for (std::size_t rank = 0; rank < 4; ++rank)
        {
            StepCells const part = dealt_cells.cut({whole, {{{field::velocity}, whole}}}, rank);
            auto const own = listed(*part.solid, first_cell[rank]);
            EXPECT_EQ(listed(part.needed.at(0).cells, first_cell[rank]), own);
            EXPECT_EQ(part.needed[0].fields, std::vector<std::string>{field::velocity});
            for (std::int32_t const c : own)
                EXPECT_TRUE(c >= first_cell[rank] && c < first_cell[rank + 1]) << c << " in rank " << rank;
            found.insert(found.end(), own.begin(), own.end());
        }
        EXPECT_EQ(found, listed(whole, 0));
    }
    EXPECT_FALSE(dealt_cells.cut(StepCells{}, 0).solid.has_value());
}

}  // namespace
}  // namespace gimdem::test

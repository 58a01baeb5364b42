// SPDX-License-Identifier: BSD-3-Clause
/// Which cells of the next fluid are asked for.
#include "engine/FluidCoverage.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <set>

#include "BoxMesh.hpp"

namespace gimdem
{
namespace
{

/// A box of 7 x 7 x 9 cells; cell (i, j, k) has number i + 7 (j + 7 k).
PolyMesh box()
{
    return PolyMesh(test::BoxMesh::make({7, 7, 9}, {0.7, 0.7, 0.9}));
}
std::int32_t constexpr cells = 7 * 7 * 9;

std::int32_t number(int i, int j, int k)
{
    return i + 7 * (j + 7 * k);
}

std::set<std::int32_t> cells_of(std::vector<coupling::NeededCells> const& needed, std::string const& field)
{
    std::set<std::int32_t> all;
    for (auto const& some : needed)
        for (std::string const& name : some.fields)
            for (coupling::CellRun const& run : some.cells)
                for (std::int32_t c = run.first; name == field && c < run.first + run.count; ++c)
                    all.insert(c);
    return all;
}

TEST(FluidCoverage, AsksForLoadsWhereParticlesAreAndForTheVelocityTwoLayersAround)
{
    PolyMesh const mesh = box();
    FluidCoverage coverage(mesh);
    std::array<std::int32_t, 2> const occupied{number(3, 3, 4), number(0, 0, 0)};
    std::vector<std::uint8_t> drag(cells, 0);
    drag[static_cast<std::size_t>(number(3, 3, 4))] = 1;
    coverage.monitor(std::array{number(6, 6, 8)});
    coverage.look_ahead(occupied, drag);

    auto const needed = coverage.needed(false);
    EXPECT_EQ(cells_of(needed, "velocity_gradient"), (std::set{number(0, 0, 0), number(3, 3, 4)}));
    std::set const gradients{number(0, 0, 0), number(3, 3, 4), number(6, 6, 8)};
    EXPECT_EQ(cells_of(needed, "pressure_gradient"), gradients);
    EXPECT_EQ(cells_of(needed, "void_fraction_gradient"), gradients);
    EXPECT_EQ(cells_of(needed, "pressure"), std::set{number(6, 6, 8)});

    // Two steps over faces: 1 + 6 + 18 cells; gaps of up to three cells between runs are filled.
    auto const velocity = cells_of(needed, "velocity");
    for (int k = 0; k < 9; ++k)
        for (int j = 0; j < 7; ++j)
            for (int i = 0; i < 7; ++i)
            {
                bool const is_near = std::abs(i - 3) + std::abs(j - 3) + std::abs(k - 4) <= 2;
                EXPECT_TRUE(!is_near || velocity.count(number(i, j, k)) == 1) << i << ' ' << j << ' ' << k;
            }
    EXPECT_GE(velocity.size(), 25u);
    EXPECT_LE(velocity.size(), 25u + 3 * 13);  // 13 rows of cells
    EXPECT_TRUE(cells_of(coverage.needed(true), "velocity").empty()) << "in no set: needed everywhere";
}

TEST(FluidCoverage, SeesWhatItDidNotAskFor)
{
    PolyMesh const mesh = box();
    FluidCoverage coverage(mesh);
    std::vector<std::uint8_t> drag(cells, 0);
    drag[static_cast<std::size_t>(number(3, 3, 4))] = 1;
    coverage.look_ahead(std::array{number(3, 3, 4)}, drag);

    EXPECT_TRUE(coverage.has_loads(std::array{number(3, 3, 4), number(3, 3, 4)}));
    EXPECT_FALSE(coverage.has_loads(std::array{number(3, 3, 4), number(3, 3, 5)}));
    EXPECT_TRUE(coverage.has_velocity(drag));
    drag[static_cast<std::size_t>(number(4, 3, 5))] = 1;
    EXPECT_TRUE(coverage.has_velocity(drag));
    drag[static_cast<std::size_t>(number(4, 4, 5))] = 1;
    EXPECT_FALSE(coverage.has_velocity(drag)) << "three faces away";
    static_cast<void>(coverage.needed(true));
    EXPECT_TRUE(coverage.has_velocity(drag)) << "all of it was asked for";
}

TEST(FluidCoverage, ForgetsTheStepBefore)
{
    PolyMesh const mesh = box();
    FluidCoverage coverage(mesh);
    std::vector<std::uint8_t> drag(cells, 1);
    coverage.look_ahead(std::array{number(1, 1, 1)}, drag);
    EXPECT_EQ(cells_of(coverage.needed(false), "velocity").size(), static_cast<std::size_t>(cells));
    drag.assign(cells, 0);
    coverage.look_ahead({}, drag);
    for (auto const& some : coverage.needed(false))
        EXPECT_TRUE(some.cells.empty());
    EXPECT_FALSE(coverage.has_loads(std::array{number(1, 1, 1)}));
}

}  // namespace
}  // namespace gimdem

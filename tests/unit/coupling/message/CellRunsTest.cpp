// SPDX-License-Identifier: BSD-3-Clause
/// Where one run of cells ends and the next begins, and which arrays they belong to.
#include "gimdem/coupling/CellRuns.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "gimdem/coupling/Error.hpp"
#include "message/Codec.hpp"
#include "message/StepMessages.hpp"

namespace gimdem::coupling::message
{
namespace
{

TEST(CellRuns, AreJoinedAcrossThreeCellsAndNoMore)
{
    std::vector<std::uint8_t> flags(30);
    for (std::size_t const c : {2u, 6u, 11u})  // three cells between the first two, four between the others
        flags[c] = 1;

    CellRuns const runs = runs_where(flags);

    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[0].first, 2);
    EXPECT_EQ(runs[0].count, 5);
    EXPECT_EQ(runs[1].first, 11);
    EXPECT_EQ(runs[1].count, 1);
}

TEST(CellRuns, OfTheArrayBeforeHoldOnlyIfTheyAreTheSame)
{
    std::size_t constexpr cells = 100;
    Terms both;
    both.fluid = choose_fluid_fields({"velocity", "pressure_gradient"}, Fault::user);
    both.cell_count = cells;
    both.encodings = {true, false, false};
    both.needed = {{{"velocity"}, {{3, 4}, {50, 6}}}, {{"pressure_gradient"}, {{3, 4}, {50, 7}}}};
    std::vector<double> const ones(3 * cells, 1.5);
    FluidState sent;
    sent.step = {1, 0, 1e-3};
    sent.fields.velocity = sent.fields.pressure_gradient = ones;

    Message const message = decode(encode(pack(sent, both)));
    FluidState const got = unpack_fluid_state(message, both);

    EXPECT_EQ(got.fields.velocity[3 * 56], 0);
    EXPECT_EQ(got.fields.pressure_gradient[3 * 56], 1.5);
}

TEST(SharedBytes, AreThoseOfLargeFieldsUnlessTheOthersTravelWithThem)
{
    auto const fields = choose_solid_fields({"void_fraction", "drag_momentum"}, Fault::user);

    EXPECT_EQ(shared_bytes(fields, 10, false), 0u);
    EXPECT_EQ(shared_bytes(fields, 10, true), 0u) << "no large one takes the small ones along";
    // 100 cells: 800 bytes of one, 2400 of the other, in blocks of 64.
    EXPECT_EQ(shared_bytes(fields, 100, false), 2432u);
    EXPECT_EQ(shared_bytes(fields, 100, true), 832u + 2432u);
}

}  // namespace
}  // namespace gimdem::coupling::message

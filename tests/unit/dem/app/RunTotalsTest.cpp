// SPDX-License-Identifier: BSD-3-Clause
#include "app/RunTotals.hpp"

#include <gtest/gtest.h>

#include "Figures.hpp"

namespace gimdem::test
{
namespace
{

using app::RunTotals;
using coupling::Schedule;

// All numbers of this file are sums of few powers of two: exact.

coupling::FluidState fluid_of(std::int64_t step, int pass, double compute, double exchange, double waiting)
{
    coupling::FluidState fluid;
    fluid.step = {step, 0.5 * static_cast<double>(step), 0.5};
    fluid.pass = pass;
    fluid.previous.compute = compute;
    fluid.exchange = exchange;
    fluid.waiting = waiting;
    return fluid;
}

StepReport report_of(std::int64_t dem_steps, coupling::Timings const& timings)
{
    StepReport report;
    report.dem_steps = dem_steps;
    report.timings = timings;
    return report;
}

/// Two steps from 0.5 s on, the second in two passes.
RunTotals two_steps()
{
    RunTotals totals;
    totals.begin(0.5);
    StepReport first = report_of(10, {1, 0.5, 0.25}), second = report_of(20, {2, 1, 0.5});
    first.momentum_imbalance = 0.25, second.momentum_imbalance = 0.125;
    first.volume_imbalance = 0.0625, second.volume_imbalance = 0.5;
    first.void_fraction_min = 0.375, second.void_fraction_min = 0.5;
    first.void_fraction_max = 0.75, second.void_fraction_max = 0.875;
    first.cell_clips = 3, second.cell_clips = 4;
    totals.add_work(fluid_of(1, 0, 0, 0, 0), first);
    totals.add(fluid_of(1, 0, 0, 0, 0).step, first, 5);
    totals.add_work(fluid_of(2, 0, 4, 0.25, 1), second);
    totals.add_work(fluid_of(2, 1, 4, 0.5, 1.5), second);
    totals.add(fluid_of(2, 1, 0, 0, 0).step, second, 7);
    return totals;
}

TEST(RunTotals, CountStepsAndTimeThatStand)
{
    output::Summary summary;
    two_steps().add_progress(summary);

    EXPECT_EQ(value_of(summary, "simulated_time"), 1.0);
    EXPECT_EQ(value_of(summary, "coupling_steps"), 2);
    EXPECT_EQ(value_of(summary, "dem_steps"), 30);
}

TEST(RunTotals, KeepTheWorstOfEachBalance)
{
    output::Summary summary;
    two_steps().add_balances(summary);

    EXPECT_EQ(value_of(summary, "momentum_imbalance"), 0.25);
    EXPECT_EQ(value_of(summary, "volume_imbalance"), 0.5);
    EXPECT_EQ(value_of(summary, "void_fraction_min"), 0.375);
    EXPECT_EQ(value_of(summary, "void_fraction_max"), 0.875);
    EXPECT_EQ(value_of(summary, "void_fraction_clips"), 7);
    EXPECT_EQ(value_of(summary, "void_fraction_clips_at_particles"), 7) << "the engine counts those itself";
}

TEST(RunTotals, ShareTheWallTimeOut)
{
    output::Summary serial, overlapped;
    two_steps().add_shares(16, Schedule::serial, serial);
    two_steps().add_shares(16, Schedule::overlapped, overlapped);

    EXPECT_EQ(value_of(serial, "wall_time"), 16);
    EXPECT_EQ(value_of(serial, "wall_time_per_simulated_second"), 16);
    EXPECT_EQ(value_of(serial, "share_dem"), 5.0 / 16) << "1 + 2 passes of 2";
    EXPECT_EQ(value_of(serial, "share_mapping"), 2.5 / 16);
    EXPECT_EQ(value_of(serial, "share_output"), 1.25 / 16);
    EXPECT_EQ(value_of(serial, "share_cfd"), 4.0 / 16) << "told with the first pass alone";
    EXPECT_EQ(value_of(serial, "share_exchange"), 0.5 / 16) << "as the client last told";
    EXPECT_EQ(value_of(serial, "share_waiting"), 2.75 / 16) << "what is left";
    EXPECT_EQ(value_of(overlapped, "share_waiting"), 1.5 / 16) << "what the client told";
}

TEST(RunTotals, WithoutAStepHaveNoShares)
{
    output::Summary summary;
    RunTotals().add_shares(0, Schedule::serial, summary);
    EXPECT_TRUE(summary.figures().empty());
}

}  // namespace
}  // namespace gimdem::test

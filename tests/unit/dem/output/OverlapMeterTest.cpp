// SPDX-License-Identifier: BSD-3-Clause
#include "output/OverlapMeter.hpp"

#include <gtest/gtest.h>

namespace
{

using namespace gimdem::output;

constexpr double rounding = 1e-15;

TEST(OverlapMeter, GivesOneWhereTheShorterSolverHidesBehindTheLonger)
{
    for (StepTimes const& t : {StepTimes{3, 2, 3}, StepTimes{2, 3, 3}, StepTimes{2, 2, 2}})
    {
        OverlapMeter meter;
        meter.add(t);
        EXPECT_NEAR(meter.efficiency(), 1, rounding);
        EXPECT_NEAR(meter.wall_over_longer(), 1, rounding);
    }
}

TEST(OverlapMeter, GivesZeroWhereOneWaitsForTheOther)
{
    OverlapMeter meter;
    meter.add({3, 2, 5});
    EXPECT_NEAR(meter.efficiency(), 0, rounding);
    EXPECT_NEAR(meter.wall_over_longer(), 5.0 / 3, rounding);
}

TEST(OverlapMeter, CountsTheExchangeAgainstTheGain)
{
    // 0.5 s of exchange: 1.5 of 2 s are saved. After one another: less than nothing.
    EXPECT_NEAR(overlap_efficiency({3, 2, 3.5}), 0.75, rounding);
    EXPECT_NEAR(overlap_efficiency({3, 2, 5.5}), -0.25, rounding);
}

TEST(OverlapMeter, WeighsStepsByWhatTheyCouldSave)
{
    OverlapMeter meter;
    meter.add({10, 10, 10});  // saves 10 of 10
    meter.add({1, 2, 3});     // saves 0 of 1
    EXPECT_NEAR(meter.efficiency(), 10.0 / 11, rounding);
    EXPECT_NEAR(meter.wall_over_longer(), 13.0 / 12, rounding);
}

TEST(OverlapMeter, HasNothingToSaveWhereOneSolverHasNothingToDo)
{
    EXPECT_EQ(overlap_efficiency({0, 2, 2}), 0);
    EXPECT_EQ(OverlapMeter{}.efficiency(), 0);
    EXPECT_EQ(OverlapMeter{}.wall_over_longer(), 0);
}

}  // namespace

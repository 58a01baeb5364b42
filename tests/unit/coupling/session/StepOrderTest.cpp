// SPDX-License-Identifier: BSD-3-Clause
#include "session/StepOrder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace gimdem::coupling::session
{
namespace
{

std::string fault(StepOrder const& order, Step const& step)
{
    return order.find_fault(step).value_or("(nothing)");
}

StepOrder after(Step const& step)
{
    StepOrder order;
    order.accept(step);
    return order;
}

TEST(StepOrder, AllowsStepsOfAnyLengthOneAfterTheOther)
{
    StepOrder order;
    double time = 0.3;  // a run may begin at any time
    for (int n = 1; n <= 100000; ++n)
    {
        Step const step{n, time, n % 2 == 0 ? 1e-4 : 3e-5};
        ASSERT_EQ(fault(order, step), "(nothing)");
        order.accept(step);
        time += step.dt;
    }
}

TEST(StepOrder, AllowsTheRoundingOfALongRun)
{
    // A client that computes t = n dt differs from one that adds dt by some 1e-12 after a million steps.
    EXPECT_EQ(fault(after({1000000, 99.9999, 1e-4}), {1000001, 100 * (1 + 5e-10), 1e-4}), "(nothing)");
    EXPECT_THAT(fault(after({1000000, 99.9999, 1e-4}), {1000001, 100 * (1 + 2e-9), 1e-4}),
                testing::HasSubstr("begins at"));
    EXPECT_THAT(fault(after({1000000, 99.9999, 1e-4}), {1000001, 100 * (1 - 2e-9), 1e-4}),
                testing::HasSubstr("begins at"));
}

TEST(StepOrder, RefusesAWrongNumber)
{
    for (int const number : {-1, 0, 2, 7})
        EXPECT_THAT(fault({}, {number, 0, 1}), testing::HasSubstr("follows step 0"));
    for (int const number : {2, 3, 5})
        EXPECT_THAT(fault(after({3, 0, 1}), {number, 1, 1}), testing::HasSubstr("follows step 3"));
}

TEST(StepOrder, RefusesAWrongTime)
{
    auto const order = after({3, 0.2, 0.1});
    EXPECT_THAT(fault(order, {4, 0.2, 0.1}),
                testing::HasSubstr("step 4 begins at 0.2 s (the step before it ended at 0.3"));
    EXPECT_THAT(fault(order, {4, 0.4, 0.1}), testing::HasSubstr("begins at 0.4 s"));
    EXPECT_THAT(fault({}, {1, std::numeric_limits<double>::quiet_NaN(), 0.1}), testing::HasSubstr("finite"));
}

TEST(StepOrder, AllowsTheLastStepAgainOfAnyLength)
{
    StepOrder order = after({3, 0.2, 0.1});
    EXPECT_FALSE(order.find_fault_of_repeat({3, 0.2, 0.1}, 1));
    order.accept_repeat({3, 0.2, 0.05}, 1);
    EXPECT_FALSE(order.find_fault_of_repeat({3, 0.2, 0.1}, 2));
    EXPECT_EQ(fault(order, {4, 0.25, 0.1}), "(nothing)") << "after the length of the last pass";
    order.accept({4, 0.25, 0.1});
    EXPECT_FALSE(order.find_fault_of_repeat({4, 0.25, 0.1}, 1)) << "passes of each step begin at 0";
}

TEST(StepOrder, RefusesToRepeatAnythingElse)
{
    auto const fault_of = [](StepOrder const& order, Step const& step, int pass)
    { return order.find_fault_of_repeat(step, pass).value_or("(nothing)"); };
    auto const order = after({3, 0.2, 0.1});
    EXPECT_THAT(fault_of({}, {0, 0, 1}, 1), testing::HasSubstr("only the last step can be repeated"));
    EXPECT_THAT(fault_of(order, {2, 0.2, 0.1}, 1), testing::HasSubstr("only the last step can be repeated"));
    EXPECT_THAT(fault_of(order, {4, 0.2, 0.1}, 1), testing::HasSubstr("only the last step can be repeated"));
    EXPECT_THAT(fault_of(order, {3, 0.2, 0.1}, 2), testing::HasSubstr("pass 2 of step 3 follows pass 0 of step 3"));
    EXPECT_THAT(fault_of(order, {3, 0.3, 0.1}, 1), testing::HasSubstr("begins at 0.3 s"));
    EXPECT_THAT(fault_of(order, {3, 0.2, 0}, 1), testing::HasSubstr("must be positive"));
}

TEST(StepOrder, RefusesAStepThatDoesNotAdvance)
{
    for (double const dt :
         {0.0, -1e-4, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_THAT(fault({}, {1, 0, dt}), testing::HasSubstr("must be positive"));
}

}  // namespace
}  // namespace gimdem::coupling::session

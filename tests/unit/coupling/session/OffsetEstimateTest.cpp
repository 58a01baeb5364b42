// SPDX-License-Identifier: BSD-3-Clause
/// The true offset of two simulated clocks must lie within what is reported, whatever the ways of the messages took.
#include "session/OffsetEstimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "session/RateLimit.hpp"

namespace gimdem::coupling::session
{
namespace
{

double constexpr rounding = 1e-9;  ///< of times near 1e5 s in doubles, summed a few times [s]

/// A client whose clock shows `offset` more than the server's. An exchange begins at a time of the server's clock [s].
void exchange(OffsetEstimate& estimate, double at, double offset, double there, double busy, double back)
{
    estimate.add(at + offset, at + there, at + there + busy, at + there + busy + back + offset);
}

TEST(OffsetEstimate, KnowsNothingBeforeTheFirstExchange)
{
    EXPECT_FALSE(OffsetEstimate().at(1.0));
}

TEST(OffsetEstimate, IsExactWhenBothWaysTakeEquallyLong)
{
    OffsetEstimate estimate;
    exchange(estimate, 1e5, -37.25, 0.25, 3.0, 0.25);
    EXPECT_NEAR(estimate.at(1e5 - 34)->offset, -37.25, rounding);
    EXPECT_NEAR(estimate.at(1e5 + 3.5 - 37.25)->uncertainty, 0.25, rounding) << "half of the round trip";
}

TEST(OffsetEstimate, HoldsTheTruthForAnyDelays)
{
    std::mt19937 random(1);
    std::exponential_distribution<double> delay(1e3);
    for (int run = 0; run < 1000; ++run)
    {
        OffsetEstimate estimate;
        for (int step = 0; step < 20; ++step)
        {
            double const at = 1e5 + 0.1 * step;
            exchange(estimate, at, 12.5, delay(random), delay(random), delay(random));
            ClockOffset const now = *estimate.at(at + 12.5);
            EXPECT_LE(std::abs(now.offset - 12.5), now.uncertainty + rounding);
        }
        // The least of 20 round trips of 2 ms on average.
        EXPECT_LT(estimate.at(1e5 + 14.5)->uncertainty, 2e-3);
    }
}

TEST(OffsetEstimate, FollowsClocksThatDrift)
{
    OffsetEstimate estimate;
    for (int second = 0; second < 36000; second += 10)
    {
        double const offset = 5 + 1e-5 * second;         // 10 parts per million
        double const delay = second == 0 ? 1e-5 : 1e-3;  // nothing later is as good as the first
        exchange(estimate, 1e5 + second, offset, delay, 0.01, 0.1 * delay);
        ClockOffset const now = *estimate.at(1e5 + second + offset);
        EXPECT_LE(std::abs(now.offset - offset), now.uncertainty + rounding) << second;
        EXPECT_LT(now.uncertainty, 2e-3) << second;
    }
}

TEST(OffsetEstimate, OfOneMachineIsNoneUnlessTheClocksProveOtherwise)
{
    OffsetEstimate same, other;
    same.expect_one_clock();
    other.expect_one_clock();
    exchange(same, 1e5, 0, 0.001, 0.1, 0.003);
    exchange(other, 1e5, 50, 0.001, 0.1, 0.003);
    EXPECT_EQ(same.at(1e5)->offset, 0);
    EXPECT_EQ(same.at(1e5)->uncertainty, 0);
    EXPECT_NEAR(other.at(1e5)->offset, 50, 0.002);
}

TEST(OffsetEstimate, PaysNoHeedToTimesThatCannotBe)
{
    OffsetEstimate estimate;
    estimate.add(10, 5, 8, 11);    // the server was busy for longer than the round trip
    estimate.add(10, 0, 0, 11);    // the server does not tell
    estimate.add(10, NAN, 5, 11);  // nor that
    EXPECT_FALSE(estimate.at(12));
}

TEST(RateLimit, AllowsSoManyASecondAndAsManyAtOnce)
{
    RateLimit limit(20);
    transport::Time const start = transport::Clock::now();
    auto const allowed_at = [&](double seconds)
    {
        int count = 0;
        while (limit.allows(start + transport::ticks(seconds)))
            ++count;
        return count;
    };
    EXPECT_EQ(allowed_at(0), 20);
    EXPECT_EQ(allowed_at(0.0001), 0);
    EXPECT_EQ(allowed_at(0.5), 10);
    EXPECT_EQ(allowed_at(100), 20) << "a long pause saves no more";
}

}  // namespace
}  // namespace gimdem::coupling::session

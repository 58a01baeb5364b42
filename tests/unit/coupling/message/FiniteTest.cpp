// SPDX-License-Identifier: BSD-3-Clause
#include "message/Finite.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace gimdem::coupling::message
{
namespace
{

using Limits = std::numeric_limits<double>;

TEST(Finite, HoldsForEveryOrdinaryNumber)
{
    std::vector<double> const values{0.0, -0.0, 1.0, -1.0, Limits::max(), Limits::lowest(), Limits::denorm_min()};
    EXPECT_TRUE(all_finite(values));
    EXPECT_FALSE(first_not_finite(values));
    EXPECT_TRUE(all_finite(Span<double const>()));
}

TEST(Finite, FailsForANanOrInfinityAnywhere)
{
    for (double const bad :
         {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::signaling_NaN()})
        for (std::size_t const where : {0u, 1u, 7u, 8u, 30u, 36u})
        {
            std::vector<double> values(37, 1.5);
            values[where] = bad;
            EXPECT_FALSE(all_finite(values)) << bad << " at " << where;
            EXPECT_EQ(first_not_finite(values), where);
        }
}

}  // namespace
}  // namespace gimdem::coupling::message

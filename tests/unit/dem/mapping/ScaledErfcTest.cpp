// SPDX-License-Identifier: BSD-3-Clause
#include "exec/ScaledErfc.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exec/Octet.hpp"

namespace
{

using gimdem::exec::Octet;

TEST(ScaledErfc, IsThatOfTheStandardLibrary)
{
    Octet x;
    for (int i = 0; i < 3000; ++i)
    {
        for (int lane = 0; lane < 8; ++lane)
            x[lane] = 1e-3 * (8 * i + lane);
        Octet const h = gimdem::exec::scaled_erfc(x);
        for (int lane = 0; lane < 8; ++lane)
        {
            long double const at = x[lane];
            EXPECT_NEAR(h[lane], static_cast<double>(std::exp(at * at) * std::erfc(at)), 1e-15) << x[lane];
        }
    }
}

TEST(ScaledErfc, VanishesAtInfinity)
{
    EXPECT_NEAR(gimdem::exec::scaled_erfc(Octet::Constant(INFINITY))[3], 0, 1e-15);
    EXPECT_NEAR(gimdem::exec::scaled_erfc(Octet::Constant(0))[3], 1, 1e-15);
}

}  // namespace

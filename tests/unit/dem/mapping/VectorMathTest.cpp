// SPDX-License-Identifier: BSD-3-Clause
#include "exec/VectorMath.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using gimdem::exec::erfc_many;
using gimdem::exec::vector_width;

double one(double x)
{
    double block[vector_width] = {x};
    erfc_many(block, 1);
    return block[0];
}

TEST(VectorMath, ErfcIsThatOfTheStandardLibrary)
{
    // The bound that the header states: e^(-x^2) is the worse conditioned the larger x.
    for (double x = -6; x < 9; x += 1e-3)
        EXPECT_NEAR(one(x) / std::erfc(x), 1, 2e-15 + 5e-16 * x * x) << x;
    EXPECT_EQ(one(0), 1);
    EXPECT_LT(one(30), 1e-300);
    EXPECT_LT(one(INFINITY), 1e-300);
}

TEST(VectorMath, ErfcOfANumberDoesNotDependOnItsNeighbours)
{
    double block[2 * vector_width];
    for (int i = 0; i < 2 * vector_width; ++i)
        block[i] = 0.1 * i - 1;
    erfc_many(block, vector_width + 5);
    for (int i = 0; i < vector_width + 5; ++i)
        EXPECT_EQ(block[i], one(0.1 * i - 1)) << i;
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "forces/Beetstra.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using gimdem::beetstra_factor;

/// Eq. 10 as it is printed, singular powers and all.
double as_printed(double s, double re)
{
    double const e = 1 - s;
    return 10 * s / (e * e) + e * e * (1 + 1.5 * std::sqrt(s)) +
           0.413 * re / (24 * e * e) * (1 / e + 3 * s * e + 8.4 * std::pow(re, -0.343)) /
               (1 + std::pow(10, 3 * s) * std::pow(re, -(1 + 4 * s) / 2));
}

TEST(Beetstra, MatchesSpotValues)
{
    // Computed independently from Eq. 10.
    EXPECT_NEAR(beetstra_factor(0.6, 10), 13.46425824209127, 1e-12);
    EXPECT_NEAR(beetstra_factor(0.45, 100), 66.39783313109821, 1e-11);
    EXPECT_NEAR(beetstra_factor(0.7, 0.5), 7.027408581924728, 1e-12);
}

TEST(Beetstra, EqualsThePrintedFormWhereThatIsRegular)
{
    for (double const s : {0.0, 0.01, 0.2, 0.4, 0.6, 0.8})
        for (double const re : {1e-6, 1e-3, 0.1, 1.0, 30.0, 1e3, 1e5})
            EXPECT_NEAR(beetstra_factor(1 - s, re) / as_printed(s, re), 1, 1e-13) << s << ' ' << re;
}

TEST(Beetstra, CreepingFlowIsTheLimitOfSmallReynoldsNumbers)
{
    for (double const s : {0.0, 0.1, 0.5})
    {
        double const limit = 10 * s / std::pow(1 - s, 2) + std::pow(1 - s, 2) * (1 + 1.5 * std::sqrt(s));
        EXPECT_EQ(beetstra_factor(1 - s, 0), limit);
        // The inertial term falls at least as Re^(0.657 + 1/2).
        EXPECT_NEAR(beetstra_factor(1 - s, 1e-12), limit, 1e-12 * limit);
    }
}

TEST(Beetstra, SingleSphereInCreepingFlowIsStokes)
{
    EXPECT_EQ(beetstra_factor(1, 0), 1.0);
}

TEST(Beetstra, IsFiniteAtTheSmallestReynoldsNumbers)
{
    for (double const re : {5e-324, 1e-308, 1e-100})
        EXPECT_NEAR(beetstra_factor(1, re), 1, 1e-12);
}

}  // namespace

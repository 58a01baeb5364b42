// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/GaussianIntegral.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace
{

using gimdem::GaussianIntegral;
using gimdem::tuned_coefficient;

/// int min(G_p, G_c) dx by the trapezoidal rule: the definition (G.5), with no branch.
double by_quadrature(double volume_ratio, double phi, double mu)
{
    double const rc = std::cbrt(volume_ratio);
    double const sp = phi, sc = phi * rc;
    double const low = -40 * std::max(sp, sc), high = mu + 40 * std::max(sp, sc);
    int const n = 200'000;
    double const h = (high - low) / n;
    double sum = 0;
    for (int i = 0; i <= n; ++i)
    {
        double const x = low + h * i;
        double const gp = std::exp(-x * x / (2 * sp * sp)) / sp;
        double const gc = volume_ratio * std::exp(-(x - mu) * (x - mu) / (2 * sc * sc)) / sc;
        sum += std::min(gp, gc);
    }
    return sum * h / std::sqrt(2 * M_PI);
}

GaussianIntegral integral(double volume_ratio, double phi)
{
    return {1.0, std::log(volume_ratio), phi};
}

struct Row
{
    double ratio, at_edge, beyond, tuned_at_edge, tuned_beyond;
};

// Values of the method at phi = 0.4 and at Eq. 27, computed independently; to the four digits printed there.
constexpr std::initializer_list<Row> table = {{2, 0.2368, 0.0181, 0.4204, 0.0849},
                                              {4, 0.2767, 0.0279, 0.4447, 0.0853},
                                              {8, 0.3399, 0.0456, 0.4561, 0.0841},
                                              {16, 0.4403, 0.0781, 0.4466, 0.0802}};

TEST(GaussianIntegral, ReproducesTheTableAtConstantCoefficient)
{
    for (Row const& row : table)
    {
        double const rc = std::cbrt(row.ratio);
        EXPECT_NEAR(integral(row.ratio, 0.4)(rc - 1), 1.0, 5e-5) << row.ratio;
        EXPECT_NEAR(integral(row.ratio, 0.4)(rc), row.at_edge, 5e-5) << row.ratio;
        EXPECT_NEAR(integral(row.ratio, 0.4)(rc + 1), row.beyond, 5e-5) << row.ratio;
    }
}

TEST(GaussianIntegral, ReproducesTheTableAtTunedCoefficient)
{
    for (Row const& row : table)
    {
        double const rc = std::cbrt(row.ratio);
        double const phi = tuned_coefficient(std::log(row.ratio));
        EXPECT_NEAR(integral(row.ratio, phi)(rc), row.tuned_at_edge, 5e-5) << row.ratio;
        EXPECT_NEAR(integral(row.ratio, phi)(rc + 1), row.tuned_beyond, 5e-5) << row.ratio;
    }
}

TEST(GaussianIntegral, IsTheIntegralOfTheMinimumInEveryBranch)
{
    // Quadrature's own error: h^2 at the kinks of the minimum, below 1e-7 here.
    for (double const ratio : {0.01, 0.3, 0.999, 1.0, 1.001, 3.0, 100.0})
        for (double const mu : {0.0, 0.05, 0.5, 1.0, 2.5})
            EXPECT_NEAR(integral(ratio, 0.45)(mu), by_quadrature(ratio, 0.45, mu), 3e-7) << ratio << ' ' << mu;
}

TEST(GaussianIntegral, WithoutCrossingTheSmallerOneIsInsideTheLarger)
{
    EXPECT_EQ(integral(8, 0.4)(0), 1.0);                 // cell larger: V_p
    EXPECT_NEAR(integral(0.125, 0.4)(0), 0.125, 1e-15);  // particle larger: V_c
}

TEST(GaussianIntegral, EqualVolumesHaveOneCrossing)
{
    for (double const mu : {0.0, 1e-9, 0.3, 1.0, 4.0})
        EXPECT_NEAR(integral(1, 0.4)(mu), std::erfc(mu / 0.4 / (2 * std::sqrt(2.0))), 4e-16) << mu;
}

TEST(GaussianIntegral, IsContinuousWhereVolumesAreEqual)
{
    for (double const mu : {0.01, 0.5, 1.0, 2.0})
        for (double const step : {1e-15, 1e-12, 1e-9})
        {
            double const equal = integral(1, 0.4)(mu);
            // |dI/d ln V| is below one, so the change is below the step plus rounding.
            EXPECT_NEAR(integral(1 + step, 0.4)(mu), equal, step + 1e-15);
            EXPECT_NEAR(integral(1 - step, 0.4)(mu), equal, step + 1e-15);
        }
}

TEST(GaussianIntegral, IsFiniteAndWithinBoundsForAnySizesAndDistances)
{
    for (double log_ratio = -40; log_ratio <= 40; log_ratio += 0.25)
        for (double const mu : {0.0, 1e-12, 1e-3, 1.0, 1e3, 1e12})
        {
            double const phi = tuned_coefficient(log_ratio);
            double const shared = GaussianIntegral{1.0, log_ratio, phi}(mu);
            EXPECT_GE(shared, 0) << log_ratio << ' ' << mu;
            EXPECT_LE(shared, std::min(1.0, std::exp(log_ratio)) * (1 + 1e-12)) << log_ratio << ' ' << mu;
        }
}

}  // namespace

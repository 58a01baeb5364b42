// SPDX-License-Identifier: BSD-3-Clause
#include "particles/SizeDistribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "core/Error.hpp"

namespace
{

using gimdem::RandomStream;
using gimdem::SizeDistribution;
using gimdem::SizeSettings;

SizeSettings between(std::string const& distribution, double mean, double deviation)
{
    SizeSettings sizes;
    sizes.distribution = distribution;
    sizes.minimum = 1e-3;
    sizes.maximum = 3e-3;
    sizes.mean = mean;
    sizes.deviation = deviation;
    return sizes;
}

/// Moments of the diameters [mm] of 40000 draws.
struct Moments
{
    double mean = 0, deviation = 0, least = 1e300, most = 0;
};

constexpr int draws = 40000;

Moments moments_of(SizeDistribution const& sizes)
{
    RandomStream random(5);
    Moments m;
    double squares = 0;
    for (int k = 0; k < draws; ++k)
    {
        double const d = 1e3 * sizes.draw(random);
        m.mean += d / draws;
        squares += d * d / draws;
        m.least = std::min(m.least, d);
        m.most = std::max(m.most, d);
    }
    m.deviation = std::sqrt(squares - m.mean * m.mean);
    return m;
}

/// Mean and deviation of a density on [1, 3] mm by the midpoint rule: the oracle, independent of any sampling.
Moments moments_of_density(std::function<double(double)> const& density)
{
    double weight = 0, first = 0, second = 0;
    constexpr int parts = 20000;
    for (int k = 0; k < parts; ++k)
    {
        double const d = 1 + 2 * (k + 0.5) / parts, w = density(d);
        weight += w;
        first += w * d;
        second += w * d * d;
    }
    Moments m;
    m.mean = first / weight;
    m.deviation = std::sqrt(second / weight - m.mean * m.mean);
    return m;
}

void expect_moments(SizeDistribution const& sizes, Moments const& oracle)
{
    Moments const drawn = moments_of(sizes);
    // Four standard errors of a mean of 40000 draws; of a deviation they are less than that of the mean.
    double const tolerance = 4 * oracle.deviation / std::sqrt(draws);
    EXPECT_NEAR(drawn.mean, oracle.mean, tolerance);
    EXPECT_NEAR(drawn.deviation, oracle.deviation, tolerance);
    EXPECT_GE(drawn.least, 1.0);
    EXPECT_LE(drawn.most, 3.0);
}

TEST(SizeDistribution, FixedIsItsDiameter)
{
    SizeDistribution const sizes(2e-3, {});
    RandomStream random(1);
    EXPECT_EQ(sizes.draw(random), 2e-3);
    EXPECT_EQ(sizes.smallest(), 2e-3);
    EXPECT_EQ(sizes.largest(), 2e-3);
}

TEST(SizeDistribution, UniformHasTheMomentsOfItsDensity)
{
    expect_moments({0, between("uniform", 0, 0)}, moments_of_density([](double) { return 1.0; }));
}

TEST(SizeDistribution, TruncatedNormalHasTheMomentsOfItsDensity)
{
    auto const density = [](double d) { return std::exp(-0.5 * std::pow((d - 1.6) / 0.5, 2)); };
    expect_moments({0, between("normal", 1.6e-3, 5e-4)}, moments_of_density(density));
}

TEST(SizeDistribution, TruncatedLognormalHasTheMomentsOfItsDensity)
{
    // Mean 1.5 mm and deviation 0.6 mm before truncation: s^2 = ln(1 + 0.16), mu = ln 1.5 - s^2 / 2.
    double const s2 = std::log(1.16), mu = std::log(1.5) - s2 / 2;
    auto const density = [=](double d) { return std::exp(-0.5 * std::pow(std::log(d) - mu, 2) / s2) / d; };
    expect_moments({0, between("lognormal", 1.5e-3, 6e-4)}, moments_of_density(density));
}

TEST(SizeDistribution, DiscreteSizesHaveTheirSharesOfTheMass)
{
    SizeSettings sizes;
    sizes.distribution = "discrete";
    sizes.diameters = {1e-3, 2e-3, 4e-3};
    sizes.mass_fractions = {0.2, 0.3, 0.5};
    SizeDistribution const distribution(0, sizes);
    RandomStream random(9);
    std::map<double, double> volume;
    double total = 0;
    for (int k = 0; k < 400000; ++k)
    {
        double const d = distribution.draw(random);
        volume[d] += d * d * d;
        total += d * d * d;
    }
    ASSERT_EQ(volume.size(), 3u);
    // Shares by number 0.2, 0.3/8, 0.5/64 of 0.2453: some 12700 of the largest; four standard errors are 4 % of it.
    EXPECT_NEAR(volume[4e-3] / total, 0.5, 0.02);
    EXPECT_NEAR(volume[2e-3] / total, 0.3, 0.012);
    EXPECT_NEAR(volume[1e-3] / total, 0.2, 0.012);
    EXPECT_EQ(distribution.smallest(), 1e-3);
    EXPECT_EQ(distribution.largest(), 4e-3);
}

TEST(SizeDistribution, RangeWithoutWeightIsRefused)
{
    EXPECT_THROW(SizeDistribution(0, between("normal", 9e-3, 1e-4)), gimdem::UserError);
}

TEST(RandomStream, GoesOnFromItsState)
{
    RandomStream a(3);
    a.bits();
    RandomStream b(a.state());
    EXPECT_EQ(a.bits(), b.bits());
    // The published first output of SplitMix64 from the seed 1234567.
    EXPECT_EQ(RandomStream(1234567).bits(), 6457827717110365317u);
}

}  // namespace

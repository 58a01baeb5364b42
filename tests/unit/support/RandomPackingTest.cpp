// SPDX-License-Identifier: BSD-3-Clause
#include "RandomPacking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/Error.hpp"

namespace
{

using gimdem::Vec3;
using gimdem::test::RandomPacking;

constexpr double diameter = 1.5e-3;
constexpr std::int64_t count = 1000;

/// A cube that 1000 spheres fill to a solid fraction of 0.4.
Vec3 cube()
{
    return Vec3::Constant(diameter * std::cbrt(count * std::numbers::pi / 6 / 0.4));
}

TEST(RandomPacking, HasAllSpheresInTheBoxWithoutOverlap)
{
    RandomPacking packing(count, {0, 0, 0}, cube(), diameter);
    packing.shake(30);

    auto const& x = packing.centres();
    ASSERT_EQ(std::ssize(x), count);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        EXPECT_GE(x[i].minCoeff(), diameter / 2);
        EXPECT_GE((cube() - x[i]).minCoeff(), diameter / 2 * (1 - 1e-12));
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GE((x[i] - x[j]).norm(), diameter * (1 - 1e-12)) << i << ' ' << j;
    }
}

TEST(RandomPacking, IsThatOfAFluidOfHardSpheres)
{
    RandomPacking packing(count, {0, 0, 0}, cube(), diameter);
    packing.shake(200);

    // Neighbours nearer than 1.1 diameters, of spheres away from the walls: the shell has room for
    // 8 s (1.1^3 - 1) = 1.06, times the mean of the pair correlation within it. That is 3.7 at contact (Carnahan and
    // Starling: (1 - s/2) / (1 - s)^3) and 2.3 at 1.1 (Percus and Yevick). The lattice has none. 300 spheres: 0.2.
    auto const& x = packing.centres();
    double pairs = 0, inner = 0;
    for (Vec3 const& a : x)
    {
        if (a.minCoeff() < 2 * diameter || (cube() - a).minCoeff() < 2 * diameter) continue;
        inner += 1;
        for (Vec3 const& b : x)
            pairs += &a != &b && (a - b).norm() < 1.1 * diameter;
    }
    EXPECT_NEAR(pairs / inner, 1.06 * 3.0, 0.45);
}

TEST(RandomPacking, RefusesWhatDoesNotFit)
{
    EXPECT_THROW(RandomPacking(2, {0, 0, 0}, Vec3::Constant(1.9 * diameter), diameter), gimdem::UserError);
    EXPECT_THROW(RandomPacking(1, {0, 0, 0}, Vec3::Constant(0.9 * diameter), diameter), gimdem::UserError);
    EXPECT_EQ(RandomPacking(1, {0, 0, 0}, Vec3::Constant(1.9 * diameter), diameter).centres().size(), 1u);
}

}  // namespace

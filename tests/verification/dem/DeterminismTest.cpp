// SPDX-License-Identifier: BSD-3-Clause
/// The same bits for any number of threads.
#include <gtest/gtest.h>

#include <cstring>

#include "Figure.hpp"
#include "SphereBox.hpp"
#include "search/PairSprings.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::Case;
using gimdem::Vec3;
using gimdem::exec::Backend;
using gimdem::exec::Execution;

/// 600 spheres of different sizes that fall into a heap, roll and rub, after 2000 steps.
SphereBox heap(Execution execution, std::string const& precision)
{
    Case settings = bead_case(0.8, 0.4);
    settings.dem.precision = precision;
    settings.dem.gravity = {0.3, 0, -9.81};
    auto spheres = random_spheres(600, {0, 0, 0}, {1, 1, 1}, 0.5e-3, 1e-3);
    for (int n = 0; n < 600; ++n)
        spheres[static_cast<std::size_t>(n)].position =
            2.2e-3 * (Vec3(n % 8, n / 8 % 8, n / 64) + Vec3::Constant(0.5)) + 1e-4 * Vec3(n % 3, n % 5, n % 7);
    return SphereBox(settings, {{0.0185, 0.0185, 0.025}, closed()}, spheres, {}, execution);
}

class DeterminismIn : public testing::TestWithParam<char const*>
{
};

TEST_P(DeterminismIn, ThreadsDoNotChangeABitIn2000Steps)
{
    auto const same = [](auto const& x, auto const& y)
    { return x.size() == y.size() && std::memcmp(x.host().data(), y.host().data(), x.host().size_bytes()) == 0; };
    SphereBox one = heap(serial, GetParam());
    one.run(2000, 2e-5);
    auto const& a = one.particles();
    int touching = 0;
    for (auto const& f : a.force.host())
        touching += f.xyz().norm() > 0;
    figure("determinism_touching", touching);
    EXPECT_GT(touching, 200);  // a heap, not a gas
    for (int threads : {1, 2, 3})
    {
        SphereBox many = heap({Backend::openmp, threads}, GetParam());
        many.run(2000, 2e-5);
        auto const& b = many.particles();
        EXPECT_TRUE(same(a.id, b.id)) << threads;
        EXPECT_TRUE(same(a.position, b.position)) << threads;
        EXPECT_TRUE(same(a.velocity, b.velocity)) << threads;
        EXPECT_TRUE(same(a.angular_velocity, b.angular_velocity)) << threads;
        EXPECT_TRUE(same(a.force, b.force)) << threads;
        EXPECT_TRUE(same(tangential_of_pairs(one.system().neighbors()), tangential_of_pairs(many.system().neighbors())))
            << threads;
    }
}

INSTANTIATE_TEST_SUITE_P(Precision, DeterminismIn, testing::Values("double", "mixed"));

}  // namespace

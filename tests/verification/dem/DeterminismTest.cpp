// SPDX-License-Identifier: BSD-3-Clause
/// The same bits for any number of threads, and after a restart.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "Figure.hpp"
#include "SameBits.hpp"
#include "SphereBox.hpp"
#include "engine/Checkpoint.hpp"
#include "search/PairSprings.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::Case;
using gimdem::Vec3;
using gimdem::exec::Backend;
using gimdem::exec::Execution;

Case heap_case(std::string const& precision)
{
    Case settings = bead_case(0.8, 0.4);
    settings.dem.precision = precision;
    settings.dem.gravity = {0.3, 0, -9.81};
    return settings;
}

/// Spheres of different sizes that fall into a heap, roll and rub. The neighbour list works on blocks of 1024.
SphereBox heap(std::string const& precision, int count, Execution execution)
{
    auto spheres = random_spheres(count, {0, 0, 0}, {1, 1, 1}, 0.5e-3, 1e-3);
    for (int n = 0; n < count; ++n)
        spheres[static_cast<std::size_t>(n)].position =
            2.2e-3 * (Vec3(n % 12, n / 12 % 12, n / 144) + Vec3::Constant(0.5)) + 1e-4 * Vec3(n % 3, n % 5, n % 7);
    return SphereBox(heap_case(precision), {{0.0275, 0.0275, 0.04}, closed()}, spheres, {}, execution);
}

void expect_same(SphereBox const& one, SphereBox const& other, std::string const& what)
{
    auto const &a = one.particles(), &b = other.particles();
    EXPECT_TRUE(same_bits(a.id, b.id)) << what;
    EXPECT_TRUE(same_bits(a.position, b.position)) << what;
    EXPECT_TRUE(same_bits(a.velocity, b.velocity)) << what;
    EXPECT_TRUE(same_bits(a.angular_velocity, b.angular_velocity)) << what;
    EXPECT_TRUE(same_bits(a.force, b.force)) << what;
    EXPECT_TRUE(same_bits(a.torque, b.torque)) << what;
    EXPECT_TRUE(
        same_bits(tangential_of_pairs(one.system().neighbors()), tangential_of_pairs(other.system().neighbors())))
        << what;
}

constexpr double dt = 2e-5;

class DeterminismIn : public testing::TestWithParam<char const*>
{
};

TEST_P(DeterminismIn, ThreadsDoNotChangeABitIn1000Steps)
{
    SphereBox one = heap(GetParam(), 2100, serial);
    one.run(1000, dt);
    for (int threads : {1, 2, 3})
    {
        SphereBox many = heap(GetParam(), 2100, {Backend::openmp, threads});
        many.run(1000, dt);
        expect_same(one, many, std::to_string(threads) + " threads");
    }
}

TEST_P(DeterminismIn, TwoThreadsAndARestartDoNotChangeABitIn10000Steps)
{
    constexpr std::int64_t steps = 10'000;
    SphereBox one = heap(GetParam(), 1300, serial);
    one.run(steps, dt);
    int touching = 0;
    for (auto const& f : one.particles().force.host())
        touching += f.xyz().norm() > 0;
    figure("determinism_touching", touching);
    EXPECT_GT(touching, 1200);  // a heap, not a gas
    EXPECT_GT(one.system().rebuilds(), 20);

    auto const file = std::filesystem::temp_directory_path() / ("gimdem-middle-" + std::to_string(::getpid()) + ".h5");
    std::vector<gimdem::Inlet> none;
    SphereBox two = heap(GetParam(), 1300, {Backend::openmp, 2});
    two.run(steps / 2, dt);
    gimdem::write_checkpoint(file, heap_case(GetParam()), {steps / 2, steps / 2 * dt}, none, two.system());
    two.run(steps / 2, dt);
    expect_same(one, two, "2 threads");

    SphereBox again = heap(GetParam(), 1300, serial);
    gimdem::RunPoint const at = gimdem::read_checkpoint(file, heap_case(GetParam()), none, again.system());
    std::filesystem::remove(file);
    ASSERT_EQ(at.step, steps / 2);
    again.run(steps - at.step, dt);
    expect_same(one, again, "restarted");
}

INSTANTIATE_TEST_SUITE_P(Precision, DeterminismIn, testing::Values("double", "mixed"));

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
// A granular gas that cools by its collisions, against two other programs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "OpenSpaceSystem.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::ParticleState;
using gimdem::Vec3;

double constexpr side = 0.04836;  // [m]
double constexpr dt = 2e-5;       // [s]

/// The generator of the start state: a linear congruence, modulus 2^64, whose upper 53 bits are the number in (0, 1).
struct Random
{
    std::uint64_t state = 12345;

    double operator()()
    {
        state = 6364136223846793005u * state + 1442695040888963407u;
        return (static_cast<double>(state >> 11) + 0.5) * 0x1p-53;
    }
};

/// 17,563 spheres of 1.545 mm, solid fraction 0.3, on a lattice of 26 x 26 x 26 places with jitter; velocities Gaussian
/// with 0.1 m/s a component (Box-Muller), their mean taken off.
std::vector<Sphere> start_state()
{
    int constexpr count = 17563, across = 26;
    double constexpr jitter = 1.5e-4, speed = 0.1;
    Vec3 const step(side / across, side / across, 1.86e-3);
    Random random;
    std::vector<Sphere> spheres;
    for (int i = 0; i < count; ++i)
    {
        Vec3 x = step.cwiseProduct(Vec3(i % across + 0.5, i / across % across + 0.5, i / across / across + 0.5));
        for (int axis = 0; axis < 3; ++axis)
            x[axis] += jitter * (2 * random() - 1);
        spheres.push_back({x, 1.545e-3 / 2});
    }
    Vec3 mean = Vec3::Zero();
    for (Sphere& s : spheres)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            double const u = random(), angle = 2 * std::numbers::pi * random();
            s.velocity[axis] = speed * std::sqrt(-2 * std::log(u)) * std::cos(angle);
        }
        mean += s.velocity / count;
    }
    for (Sphere& s : spheres)
        s.velocity -= mean;
    return spheres;
}

double kinetic_energy(ParticleState const& p)
{
    double sum = 0;
    for (auto const& v : p.velocity.host())
        sum += 0.5 * v.xyz().squaredNorm() / v.w;
    return sum;
}

/// Translational energy [J] at a time [s].
struct Sample
{
    double time, liggghts, lammps;
};

class CoolingGasIn : public testing::TestWithParam<char const*>
{
};

TEST_P(CoolingGasIn, LosesItsEnergyAsInOtherPrograms)
{
    fmt::print("precision = {}\n", GetParam());
    // LIGGGHTS 3.8.0, pair style gran/hertz/tangential history, and LAMMPS of 29 Sep 2021, pair style granular
    // hertz/material with mindlin (its Tsuji damping fed with the e that gives 0.9), run from this very state. The two
    // agree within 1.4 %: the motion is chaotic, so that only its statistics can be compared, and 17,563 particles make
    // no better statistics.
    Sample const samples[] = {{0.01, 2.370e-4, 2.383e-4}, {0.02, 1.343e-4, 1.355e-4}, {0.04, 6.261e-5, 6.338e-5},
                              {0.06, 3.665e-5, 3.689e-5}, {0.08, 2.424e-5, 2.446e-5}, {0.10, 1.752e-5, 1.756e-5}};
    gimdem::Case settings = bead_case(0.9, 0.3);
    settings.dem.skin = 0.3;
    settings.dem.precision = GetParam();
    settings.domain.periodic = {true, true, true};
    settings.domain.box = {{{0, 0, 0}, {side, side, side}}};
    OpenSpaceSystem gas(settings, start_state(), gimdem::exec::make_execution("openmp", 2));
    ParticleState const& p = gas.system.particles();
    // Four digits are known.
    ASSERT_NEAR(kinetic_energy(p), 5.847e-4, 0.5e-7);

    double time = 0;
    for (Sample const& sample : samples)
    {
        gas.run(static_cast<int>(std::lround((sample.time - time) / dt)), dt);
        time = sample.time;
        double const energy = kinetic_energy(p);
        fmt::print("figure: cooling_gas_{:.0f}ms = {:.4g} [J], {:+.2f} % of LIGGGHTS, {:+.2f} % of LAMMPS\n",
                   1e3 * time, energy, 100 * (energy / sample.liggghts - 1), 100 * (energy / sample.lammps - 1));
        EXPECT_NEAR(energy / sample.liggghts, 1, 0.015) << time;
    }
}

INSTANTIATE_TEST_SUITE_P(Precision, CoolingGasIn, testing::Values("double", "mixed"));

}  // namespace

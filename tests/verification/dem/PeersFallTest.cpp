// SPDX-License-Identifier: BSD-3-Clause
/// The first 1000 steps of the peers' bed: the start state, and that both fall alike.
#include <gtest/gtest.h>

#include "Figure.hpp"
#include "PeersBed.hpp"

namespace
{

using namespace gimdem::test;

TEST(PeersFall, StartStateIsTheirs)
{
    auto const spheres = PeersBed::lattice();
    // First, second and last particle of the peers' data file, digit by digit.
    EXPECT_EQ(spheres[0].position, gimdem::Vec3(0.000882873581796, 0.000929615588775, 0.0010656871978));
    EXPECT_EQ(spheres[1].position, gimdem::Vec3(0.0031007212229, 0.000947689318516, 0.000968141669169));
    EXPECT_EQ(spheres.back().position, gimdem::Vec3(0.0249872301042, 0.00499045298333, 0.18531294591));
}

TEST(PeersFall, KineticEnergyAtStep1000IsTheirs)
{
    auto const bed = PeersBed::make();
    bed->run(1000, PeersBed::dt);
    double const energy = kinetic_energy(bed->particles());
    figure("peers_bed_kinetic_energy_1000", energy, "J");
    // LIGGGHTS 7.200e-4, LAMMPS 7.199e-4: the digits known, and 0.1 % for the order of summation.
    EXPECT_NEAR(energy, 7.200e-4, 1e-3 * 7.200e-4);
}

}  // namespace

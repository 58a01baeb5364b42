// SPDX-License-Identifier: BSD-3-Clause
/// The peers' bed from the lattice to rest.
#include <gtest/gtest.h>

#include "Figure.hpp"
#include "PeersBed.hpp"

namespace
{

using namespace gimdem::test;

void print(std::string const& time, BedFigures const& f)
{
    figure("peers_bed_" + time + "_kinetic_energy", f.kinetic_energy, "J");
    figure("peers_bed_" + time + "_twice_mean_height", f.twice_mean_height, "m");
    figure("peers_bed_" + time + "_coordination", f.coordination);
    figure("peers_bed_" + time + "_mean_overlap", f.mean_overlap, "diameters");
    figure("peers_bed_" + time + "_solid_fraction", f.solid_fraction);
}

class PeersBedIn : public testing::TestWithParam<char const*>
{
};

TEST_P(PeersBedIn, FallsAndSettlesLikeTheirs)
{
    fmt::print("precision = {}\n", GetParam());
    auto const bed = PeersBed::make(serial, GetParam());
    int done = 0;
    // LIGGGHTS and LAMMPS, before the packing becomes chaotic: they differ by 0.05 % at most.
    for (auto const& [step, want] : {std::pair{1000, 7.200e-4}, {3000, 5.579e-3}, {5000, 1.03564e-2}})
    {
        bed->run(step - done, PeersBed::dt);
        done = step;
        double const energy = kinetic_energy(bed->particles());
        figure(fmt::format("peers_bed_kinetic_energy_{}", step), energy, "J");
        EXPECT_NEAR(energy, want, 1e-3 * want) << step;
    }
    bed->run(15'000 - done, PeersBed::dt);
    print("0.3s", figures_of(*bed));
    bed->run(12'000, PeersBed::dt);
    BedFigures const rest = figures_of(*bed);
    print("0.54s", rest);
    // Bands around three codes, each on one or two ranks. The packing is chaotic: positions moved by 1e-12 m at the
    // start end in another one. Five of ours had solid fractions of 0.6416 with a deviation of 0.0010, six of theirs
    // 0.6404 with 0.0008: three deviations for one packing.
    EXPECT_LT(rest.kinetic_energy, 1e-8);
    EXPECT_NEAR(rest.twice_mean_height, 0.0740, 0.0002);
    EXPECT_NEAR(rest.coordination, 5.835, 0.035);
    // 0.0247 to 0.0252 with the digits that they are given by: LAMMPS itself ends at 0.02466, as we do in single
    // precision.
    EXPECT_NEAR(rest.mean_overlap, 0.02495, 0.0003);
    EXPECT_NEAR(rest.solid_fraction, 0.6404, 0.003);
}

INSTANTIATE_TEST_SUITE_P(Precision, PeersBedIn, testing::Values("double", "mixed"));

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
/// Coupling steps of any length: each takes a whole number of DEM steps, and times add up.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "CoupledCloud.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

/// Lengths in units of the DEM step: whole, below one, just above and just below a whole number.
std::vector<double> const lengths{1, 10, 0.3, 7.5, 2 + 1e-12, 3 - 1e-12, 1.0001, 100, 0.01, 33.3};

TEST(VariableStep, TakesTheLeastWholeNumberOfDemStepsThatAreShortEnough)
{
    CoupledCloud cloud({});
    double const dem_step = CoupledCloud::dem_step;
    std::vector<std::int64_t> const expected{1, 10, 1, 8, 2, 3, 2, 100, 1, 34};
    double time = 0;
    for (std::size_t n = 0; n < lengths.size(); ++n)
    {
        double const dt = lengths[n] * dem_step;
        StepReport const report = cloud.advance({static_cast<std::int64_t>(n) + 1, time, dt}, 0);
        EXPECT_EQ(report.dem_steps, expected[n]) << lengths[n] << " DEM steps";
        time += dt;
    }
}

TEST(VariableStep, ParticlesFallForExactlyTheSumOfAllSteps)
{
    // Velocity Verlet has no error of its own in free fall, whatever the steps: x = -g T^2/2.
    CoupledCloud cloud({.gravity = -9.81, .drag = false});
    double const start = std::as_const(cloud.system).particles().position[0].x;
    double time = 0;
    std::int64_t number = 0;
    for (int round = 0; round < 5; ++round)
        for (double const length : lengths)
        {
            double const dt = length * CoupledCloud::dem_step;
            cloud.advance({++number, time, dt}, 0);
            time += dt;
        }
    ParticleState const& particles = std::as_const(cloud.system).particles();
    // Rounding of some thousand steps.
    EXPECT_NEAR(particles.velocity[0].x / (-9.81 * time), 1, 1e-12);
    EXPECT_NEAR((particles.position[0].x - start) / (-9.81 * time * time / 2), 1, 1e-9);
}

}  // namespace

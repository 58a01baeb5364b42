// SPDX-License-Identifier: BSD-3-Clause
/// A void fraction that changes in time moves the fluid, without any force.
#include <gtest/gtest.h>

#include <cmath>

#include "PrescribedParticles.hpp"

namespace gimdem::test
{
namespace
{

TEST(BreathingBed, PushesOutTheVolumeItGives)
{
    FluidCase fluid;
    fluid.lengths = {0.01, 0.01, 0.5};
    fluid.cells = {1, 1, 50};
    fluid.end_time = 0.05;
    auto const void_fraction = [](double t) { return 0.6 + 0.1 * std::sin(2 * M_PI * 10 * t); };

    int compared = 0;
    run_with(
        fluid,
        [&](Vector, double t) {
            return Solid{void_fraction(t), 500, {0, 0, 0}};
        },
        [&](Fluid const& state)
        {
            if (state.time < fluid.time_step / 2) return;
            // d(alpha)/dt + d(alpha u)/dz = 0, with the difference that the solver takes over its last step
            double const rate =
                (void_fraction(state.time) - void_fraction(state.time - fluid.time_step)) / fluid.time_step;
            for (std::size_t c = 0; c < state.volume.size(); ++c)
                ASSERT_NEAR(state.superficial(c), fluid.superficial - state.centre[c][2] * rate, 1e-6)
                    << "cell " << c << " at " << state.time << " s";
            ++compared;
        });

    EXPECT_EQ(compared, 499);
}

TEST(ClosedVessel, BearsAVoidFractionThatDoesNotAddUp)
{
    FluidCase fluid;
    fluid.ends = FluidCase::Ends::cyclic;
    fluid.cells = {4, 1, 10};
    fluid.superficial = 0;
    fluid.end_time = 0.005;

    // 1 % of the volume comes and goes, as where the server clips
    Fluid const state = run_with(fluid,
                                 [](Vector, double t) {
                                     return Solid{0.6 + 0.01 * std::sin(2 * M_PI * 100 * t), 500, {0, 0, 0}};
                                 });

    for (auto const& velocity : state.velocity)
        for (int d : {0, 1, 2})
            EXPECT_NEAR(velocity[d], d == 2 ? state.velocity[0][2] : 0, 1e-7);  // it falls as one
}

TEST(UniformBed, RelaxesToTheParticlesVelocity)
{
    FluidCase fluid;
    fluid.ends = FluidCase::Ends::cyclic;
    fluid.cells = {1, 1, 10};
    fluid.gravity = {0, 0, 0};
    fluid.end_time = 0.005;
    fluid.momentum_predictor = true;  // without it velocity and convection differ in time level, by 1e-4 here
    fluid.correctors = 2;
    Solid const solid{0.6, 2000, {0, 0, 2000 * 0.3}};

    double expected = fluid.superficial;
    double const time = fluid.time_step * solid.drag_coefficient / (solid.void_fraction * fluid.density);
    run_with(
        fluid, [&](Vector, double) { return solid; },
        [&](Fluid const& state)
        {
            // alpha rho du/dt = K (u_p - u) with the drag at the new velocity
            if (state.time > fluid.time_step / 2) expected = (expected + time * 0.3) / (1 + time);
            for (auto const& velocity : state.velocity)
                ASSERT_NEAR(velocity[2], expected, 1e-9) << "at " << state.time << " s";
        });

    EXPECT_NEAR(expected, 0.3, 1e-4);
}

}  // namespace
}  // namespace gimdem::test

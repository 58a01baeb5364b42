// SPDX-License-Identifier: BSD-3-Clause
/// Coupling steps of several fluid steps, and fluid steps whose length changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "PrescribedParticles.hpp"

namespace gimdem::test
{
namespace
{

/// A column of bed whose void fraction swings.
FluidCase breathing()
{
    FluidCase fluid;
    fluid.lengths = {0.01, 0.01, 0.5};
    fluid.cells = {1, 1, 50};
    return fluid;
}

double void_fraction(double t)
{
    return 0.6 + 0.1 * std::sin(2 * M_PI * 10 * t);
}

TEST(FluidSteps, ShareTheChangeOfTheVoidFraction)
{
    for (bool const overlapped : {false, true})
    {
        FluidCase fluid = breathing();
        fluid.fluid_steps = 4;
        fluid.overlapped = overlapped;
        fluid.end_time = 0.02;
        double const coupling_step = 4 * fluid.time_step, lag = overlapped ? coupling_step : 0;

        int compared = 0;
        run_with(
            fluid,
            [&](Vector, double t) {
                return Solid{void_fraction(t), 500, {0, 0, 0}};
            },
            [&](Fluid const& state)
            {
                EXPECT_NEAR(state.step, coupling_step, 1e-15);
                if (state.time < 1.5 * coupling_step) return;
                // In each of the four steps the void fraction changes by a fourth; else the flux of the first would
                // be four times as large, and that of the last, which is seen here, none.
                double const from = state.time - coupling_step - lag;
                double const rate = (void_fraction(from + coupling_step) - void_fraction(from)) / coupling_step;
                for (std::size_t c = 0; c < state.volume.size(); ++c)
                    ASSERT_NEAR(void_fraction(from + coupling_step) * state.velocity[c][2],
                                fluid.superficial - state.centre[c][2] * rate, 1e-6)
                        << "cell " << c << " at " << state.time << " s";
                ++compared;
            });
        EXPECT_EQ(compared, 48);
    }
}

TEST(AdjustedSteps, FollowOneAnotherWithoutGapToTheEnd)
{
    for (int const fluid_steps : {1, 3})
    {
        FluidCase fluid = breathing();
        fluid.fluid_steps = fluid_steps;
        fluid.overlapped = fluid_steps == 3;
        // The step grows by a fifth each time, from 0.1 ms to what the Courant number allows; no multiple of any of
        // them is the end.
        fluid.control = "adjustTimeStep yes; maxCo 0.3; maxDeltaT 1;\n";
        fluid.end_time = 0.0312345;

        std::vector<double> times, steps;
        run_with(
            fluid,
            [&](Vector, double t) {
                return Solid{void_fraction(t), 500, {0, 0, 0}};
            },
            [&](Fluid const& state)
            {
                times.push_back(state.time);
                steps.push_back(state.step);
                EXPECT_LT(times.size() > 2 ? state.monitors.at("courant_max") : 0, 0.33);
            });

        double sum = 0;
        for (std::size_t n = 0; n < times.size(); ++n)
        {
            EXPECT_NEAR(times[n], sum, 1e-15) << "step " << n;  // rounding of some fifty numbers of 0.03
            sum += steps[n];
        }
        EXPECT_NEAR(sum, fluid.end_time, 1e-15);
        EXPECT_GT(*std::max_element(steps.begin(), steps.end()), 2 * steps.front()) << "nothing varied, nothing shown";
    }
}

}  // namespace
}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Viscous flow between plates, driven by a constant force M: u = M/(2 alpha mu) x (H - x).
#include <gtest/gtest.h>

#include <cmath>

#include "PrescribedParticles.hpp"

namespace gimdem::test
{
namespace
{

constexpr double force = 1;  ///< [N/m^3]
constexpr double void_fraction = 0.5;

FluidCase channel(int cells)
{
    FluidCase fluid;
    fluid.lengths = {0.01, 0.001, 0.002};
    fluid.cells = {cells, 1, 2};
    fluid.ends = FluidCase::Ends::cyclic;
    fluid.sides = "noSlip";
    fluid.superficial = 0;
    fluid.viscosity = 0.01;
    fluid.gravity = {0, 0, 0};
    fluid.time_step = 2e-3;  // 13 viscous time scales until the end
    fluid.end_time = 0.2;
    fluid.tolerance = 1e-6;
    fluid.momentum_predictor = true;  // viscosity crosses many cells in a step
    fluid.correctors = 2;
    return fluid;
}

Fluid flow(FluidCase const& fluid)
{
    return run_with(fluid, [](Vector, double) { return Solid{void_fraction, 0, {0, 0, force}}; });
}

/// Largest error over the largest velocity.
double error_of(FluidCase const& fluid)
{
    Fluid const state = flow(fluid);
    double const width = fluid.lengths[0];
    double const scale = force / (2 * void_fraction * fluid.viscosity);
    double worst = 0;
    for (std::size_t c = 0; c < state.volume.size(); ++c)
    {
        double const x = state.centre[c][0];
        worst = std::max(worst, std::abs(state.velocity[c][2] - scale * x * (width - x)));
    }
    return worst / (scale * width * width / 4);
}

TEST(Channel, HasTheViscousStressOfOrderTwo)
{
    double const coarse = error_of(channel(8));
    double const fine = error_of(channel(16));

    // At a wall the difference over half a cell leaves h^2/H^2 of the largest velocity
    EXPECT_NEAR(coarse, 1.0 / 64, 1e-3 / 64);
    EXPECT_NEAR(fine, 1.0 / 256, 1e-3 / 64);
}

TEST(Channel, SendsTheVelocityGradientWithTheDerivativeFirst)
{
    FluidCase const fluid = channel(16);

    Fluid const state = flow(fluid);

    // d(u_z)/dx at a quarter of the width, M/(2 alpha mu) (H - 2 x); the gradient over two cells is exact there
    std::size_t const c = 4;
    double const slope = force / (2 * void_fraction * fluid.viscosity) * (fluid.lengths[0] - 2 * state.centre[c][0]);
    EXPECT_NEAR(state.velocity_gradient[c][2], slope, 1e-4 * slope);
    EXPECT_NEAR(state.velocity_gradient[c][6], 0, 1e-6 * slope);
}

TEST(LinearVoidFraction, HasAConstantGradient)
{
    FluidCase fluid;
    fluid.cells = {2, 1, 20};
    fluid.end_time = 2e-4;

    Fluid const state = run_with(fluid, [](Vector x, double) { return Solid{0.4 + 2 * x[2] + 3 * x[0], 100, {}}; });

    // Not in the first and last layer: on the boundary alpha is the cell's
    for (std::size_t c = 2; c < 38; ++c)
        EXPECT_NEAR(state.void_fraction_gradient[c][2], 2, 1e-10) << "cell " << c;
}

}  // namespace
}  // namespace gimdem::test

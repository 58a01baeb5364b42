// SPDX-License-Identifier: BSD-3-Clause
/// Taylor and Green's decaying vortices: u = sin(kx) cos(kz), w = -cos(kx) sin(kz), times exp(-2 nu k^2 t).
#include <gtest/gtest.h>

#include <cmath>

#include "PrescribedParticles.hpp"

namespace gimdem::test
{
namespace
{

constexpr double wave = 2 * M_PI;  ///< k [1/m]

Vector vortices(Vector x)
{
    return {std::sin(wave * x[0]) * std::cos(wave * x[2]), 0, -std::cos(wave * x[0]) * std::sin(wave * x[2])};
}

/// Root mean square error over root mean square velocity.
double error_of(int cells)
{
    FluidCase fluid;
    fluid.lengths = {1, 0.1, 1};
    fluid.cells = {cells, 1, cells};
    fluid.ends = FluidCase::Ends::cyclic;
    fluid.sides = "cyclic";
    fluid.density = 1;
    fluid.viscosity = 1e-3;
    fluid.gravity = {0, 0, 0};
    fluid.velocity = vortices;
    fluid.convection = "linear";
    fluid.tolerance = 1e-4;
    fluid.time_step = 4.0 / (cells * cells);  // so that the error in time, of order one, falls as that in space
    fluid.end_time = 0.5;

    Fluid const state = run_with(fluid, [](Vector, double) { return Solid{0.5, 0, {0, 0, 0}}; });

    double const decay = std::exp(-2 * fluid.viscosity / fluid.density * wave * wave * state.time);
    double error = 0;
    double size = 0;
    for (std::size_t c = 0; c < state.volume.size(); ++c)
    {
        Vector const exact = vortices(state.centre[c]);
        for (int d = 0; d < 3; ++d)
        {
            error += std::pow(state.velocity[c][d] - decay * exact[d], 2);
            size += std::pow(decay * exact[d], 2);
        }
    }
    return std::sqrt(error / size);
}

TEST(Vortices, ConvergeWithOrderTwo)
{
    double const coarse = error_of(16);
    double const fine = error_of(32);

    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
    EXPECT_LT(fine, 0.02);
}

}  // namespace
}  // namespace gimdem::test

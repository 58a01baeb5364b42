// SPDX-License-Identifier: BSD-3-Clause
/// Gas through particles that do not move: in one dimension dp/dz = -K u/alpha - rho g, u = superficial/alpha.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "PrescribedParticles.hpp"

namespace gimdem::test
{
namespace
{

constexpr double gravity = 9.81;

/// Largest part of a column's values that alternates from cell to cell: half the second difference, where it has the
/// other sign in the next cell.
double alternation(std::vector<double> const& column)
{
    double worst = 0;
    auto const bend = [&](std::size_t i) { return (column[i - 1] - 2 * column[i] + column[i + 1]) / 4; };
    for (std::size_t i = 1; i + 2 < column.size(); ++i)
        if (bend(i) * bend(i + 1) < 0) worst = std::max(worst, std::min(std::abs(bend(i)), std::abs(bend(i + 1))));
    return worst;
}

std::vector<double> superficial_velocities(Fluid const& fluid)
{
    std::vector<double> result;
    for (std::size_t c = 0; c < fluid.volume.size(); ++c)
        result.push_back(fluid.superficial(c));
    return result;
}

/// Column 0.5 m high; the bed fills it up to `surface`.
FluidCase column()
{
    FluidCase fluid;
    fluid.lengths = {0.0035, 0.0035, 0.5};
    fluid.cells = {1, 1, 140};
    fluid.end_time = 0.02;
    return fluid;
}

struct Bed
{
    double void_fraction = 0.45;
    double drag_coefficient = 5000;
    double surface = 0.1;

    Solid operator()(Vector centre, double) const
    {
        if (centre[2] < surface) return {void_fraction, drag_coefficient, {0, 0, 0}};
        return {};
    }

    double slope(FluidCase const& fluid) const
    {
        return drag_coefficient * fluid.superficial / (void_fraction * void_fraction) + fluid.density * gravity;
    }
};

class FixedBed : public testing::TestWithParam<double>
{
};

TEST_P(FixedBed, HasTheExactPressureDropBelowItsSharpSurface)
{
    FluidCase fluid = column();
    fluid.superficial = GetParam();
    Bed const bed;

    Fluid const state = run_with(fluid, bed);

    // The bed's cells are the first 28. Pressure there is linear, so the drop is exact but for the linear solvers,
    // 1e-10; the hand's breadth below the surface feels the convective term, limitedLinear's 3 cells.
    std::size_t const last = 24;
    double const drop = state.pressure[0] - state.pressure[last];
    EXPECT_NEAR(drop / (bed.slope(fluid) * (state.centre[last][2] - state.centre[0][2])), 1, 1e-7);
    // Above it Bernoulli's pressure is regained, or lost in eddies the grid does not see: either way less than this.
    double const total = state.pressure[0] - state.pressure[139];
    double const fast = fluid.superficial / bed.void_fraction;
    double const dynamic = 0.5 * fluid.density * (fast * fast - fluid.superficial * fluid.superficial);
    double const height = bed.surface - state.centre[0][2];
    double const free = state.centre[139][2] - bed.surface;
    EXPECT_NEAR(total, bed.slope(fluid) * height + fluid.density * gravity * free, 1.5 * dynamic);
}

TEST_P(FixedBed, DoesNotAlternateFromCellToCell)
{
    FluidCase fluid = column();
    fluid.superficial = GetParam();

    Fluid const state = run_with(fluid, Bed{});

    double const drop = state.pressure[0] - state.pressure[139];
    EXPECT_LT(alternation(state.pressure), 1e-3 * drop);
    EXPECT_LT(alternation(superficial_velocities(state)), 1e-3 * fluid.superficial);
}

TEST_P(FixedBed, LetsTheSameVolumePassEveryPlane)
{
    FluidCase fluid = column();
    fluid.superficial = GetParam();

    Fluid const state = run_with(fluid, Bed{});

    // 100 x the solvers' 1e-10
    EXPECT_THAT(superficial_velocities(state), testing::Each(testing::DoubleNear(GetParam(), 1e-8 * GetParam())));
    EXPECT_LT(state.monitors.at("continuity_error"), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(AtSuperficialVelocity, FixedBed, testing::Values(0.1, 0.9));

TEST(RandomFixedBed, HasTheExactPressureDropOfItsLayers)
{
    FluidCase fluid = column();
    fluid.superficial = 0.1;
    fluid.convection = "linear";  // keeps u^2/2, while a limiter loses some of it in every layer
    std::mt19937 random(1);
    std::vector<Solid> layers(140);
    for (Solid& layer : layers)
        layer = {std::uniform_real_distribution<>(0.3, 0.9)(random),
                 std::uniform_real_distribution<>(2e4, 2e5)(random),
                 {0, 0, 0}};
    double const height = fluid.lengths[2] / 140;
    auto const layer_at = [&](Vector centre, double) { return layers[static_cast<std::size_t>(centre[2] / height)]; };

    Fluid const state = run_with(fluid, layer_at);

    double drop = 0;  // centre to centre, so the ends count by half
    double square = 0;
    for (std::size_t i = 0; i < 140; ++i)
    {
        Solid const& layer = layers[i];
        double const slope =
            layer.drag_coefficient * fluid.superficial / std::pow(layer.void_fraction, 2) + fluid.density * gravity;
        drop += slope * height * (i == 0 || i == 139 ? 0.5 : 1);
        square = std::max(square, std::pow(fluid.superficial / layer.void_fraction, 2));
    }
    // Convection adds the difference of rho u^2/2 between the ends
    EXPECT_NEAR(state.pressure[0] - state.pressure[139], drop, fluid.density * square / 2);
    EXPECT_THAT(superficial_velocities(state), testing::Each(testing::DoubleNear(0.1, 1e-8)));
}

TEST(FixedBedPressureGradient, IsThatOfTheLocalDrag)
{
    FluidCase fluid = column();
    Bed const bed;

    Fluid const state = run_with(fluid, bed);

    // From the inlet's cell on: the pressure on the inlet follows from fixedFluxPressure.
    for (std::size_t c = 0; c < 24; ++c)
        EXPECT_NEAR(state.pressure_gradient[c][2] / -bed.slope(fluid), 1, 1e-6) << "cell " << c;
}

struct Stiff
{
    double drag_coefficient, time_step;
};

class StiffBed : public testing::TestWithParam<Stiff>
{
};

TEST_P(StiffBed, IsStableAndExact)
{
    FluidCase fluid = column();
    fluid.cells = {1, 1, 40};
    fluid.time_step = GetParam().time_step;
    fluid.end_time = 50 * fluid.time_step;
    Bed bed;
    bed.drag_coefficient = GetParam().drag_coefficient;
    bed.surface = 1;

    Fluid const state = run_with(fluid, bed);

    double const height = state.centre[39][2] - state.centre[0][2];
    EXPECT_NEAR((state.pressure[0] - state.pressure[39]) / (bed.slope(fluid) * height), 1, 1e-6);
    EXPECT_THAT(superficial_velocities(state), testing::Each(testing::DoubleNear(0.9, 1e-7)));
}

INSTANTIATE_TEST_SUITE_P(Of, StiffBed,
                         testing::Values(Stiff{1e6, 1e-4}, Stiff{1e8, 1e-4}, Stiff{1e6, 1e-2}, Stiff{1e3, 1e-6},
                                         Stiff{1e6, 1e-6}));

}  // namespace
}  // namespace gimdem::test

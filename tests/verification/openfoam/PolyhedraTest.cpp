// SPDX-License-Identifier: BSD-3-Clause
/// The fixed bed again, on polyhedra that are not aligned with the flow.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "PrescribedParticles.hpp"

namespace gimdem::test
{
namespace
{

/// Moves the points inside the box at random by up to `share` of a cell.
void shake_points(FluidProcess const& process, FluidCase const& fluid, double share)
{
    auto const file = process.folder() / "constant/polyMesh/points";
    std::ifstream in(file);
    std::ostringstream out;
    out.precision(12);
    std::mt19937 random(7);
    std::uniform_real_distribution<> shift(-share, share);
    for (std::string line; std::getline(in, line);)
    {
        Vector x;
        if (std::sscanf(line.c_str(), "(%lf %lf %lf)", &x[0], &x[1], &x[2]) != 3)
        {
            out << line << '\n';
            continue;
        }
        for (int d = 0; d < 3; ++d)
        {
            double const step = shift(random) * fluid.lengths[d] / fluid.cells[d];
            bool const on_boundary = x[d] < 1e-9 || x[d] > fluid.lengths[d] - 1e-9;
            if (!on_boundary) x[d] += step;
        }
        out << '(' << x[0] << ' ' << x[1] << ' ' << x[2] << ")\n";
    }
    in.close();
    std::ofstream(file) << out.str();
}

TEST(Polyhedra, HaveThePressureDropOfTheBed)
{
    FluidCase fluid;
    fluid.lengths = {0.02, 0.02, 0.06};
    fluid.cells = {6, 6, 18};
    fluid.gradient = "leastSquares";
    fluid.end_time = 0.005;
    fluid.tolerance = 1e-7;
    double const void_fraction = 0.45;
    double const drag = 5000;

    FluidProcess process(fluid);
    shake_points(process, fluid, 0.25);
    process.run("mv 0 fields && polyDualMesh 75 -overwrite && mkdir -p 0 && mv fields/* 0");
    Fluid const state = run_with(process, fluid.end_time,
                                 [&](Vector, double) {
                                     return Solid{void_fraction, drag, {0, 0, 0}};
                                 });

    // Uniform flow and linear pressure are a solution of the discrete equations, but for where OpenFOAM and this test
    // put the centre of a cell with warped faces, a hundredth of a cell apart
    double const slope = drag * fluid.superficial / (void_fraction * void_fraction) + fluid.density * 9.81;
    EXPECT_EQ(state.volume.size(), 7 * 7 * 19) << "a cell of the dual mesh round each point";
    double volume = 0;
    double mean = 0;
    for (std::size_t c = 0; c < state.volume.size(); ++c)
    {
        EXPECT_NEAR(state.pressure[c], slope * (fluid.lengths[2] - state.centre[c][2]),
                    0.002 * slope * fluid.lengths[2]);
        EXPECT_NEAR(state.superficial(c), fluid.superficial, 1e-4 * fluid.superficial);
        volume += state.volume[c];
        mean += state.superficial(c) * state.volume[c];
    }
    EXPECT_NEAR(mean / volume, fluid.superficial, 1e-6 * fluid.superficial);
    EXPECT_NEAR(volume, 0.02 * 0.02 * 0.06, 1e-10);
}

}  // namespace
}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// The fixed bed again, on polyhedra that are not aligned with the flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "Figure.hpp"
#include "PrescribedParticles.hpp"
#include "mesh/PolyMesh.hpp"

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

/// A box of polyhedra with warped faces.
void make_polyhedra(FluidProcess const& process, FluidCase const& fluid)
{
    shake_points(process, fluid, 0.25);
    process.run("mv 0 fields && polyDualMesh 75 -overwrite && mkdir -p 0 && mv fields/* 0");
}

/// The numbers of OpenFOAM's file of a field, cell after cell; `per_cell` of them for each.
std::vector<double> internal_field(std::filesystem::path const& file, std::size_t per_cell)
{
    std::ifstream in(file);
    std::string word;
    while (in >> word && word != "internalField")
        ;
    std::size_t cells = 0;
    in >> word >> word >> cells;
    std::vector<double> values;
    in.ignore(16, '(');
    for (std::size_t i = 0; i < cells * per_cell; ++i)
    {
        while (in.peek() == '(' || in.peek() == ')' || std::isspace(in.peek()) != 0)
            in.get();
        in >> values.emplace_back();
    }
    return in ? values : std::vector<double>{};
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
    make_polyhedra(process, fluid);
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

// 1e-10 of a cell is what the files hold: 12 digits, and a volume is a difference of larger numbers.
TEST(Polyhedra, HaveTheVolumesAndCentroidsOfOpenFoam)
{
    FluidCase fluid;
    fluid.lengths = {0.02, 0.02, 0.06};
    fluid.cells = {5, 4, 9};
    fluid.end_time = fluid.time_step;
    FluidProcess process(fluid);
    make_polyhedra(process, fluid);
    process.run("postProcess -func writeCellVolumes -time 0 && postProcess -func writeCellCentres -time 0");
    Fluid const state = run_with(process, fluid.end_time, [](Vector, double) { return Solid{}; });

    PolyMesh const mesh(state.mesh);
    std::vector<double> const volumes = internal_field(process.folder() / "0/V", 1);
    std::vector<double> const centres = internal_field(process.folder() / "0/C", 3);
    ASSERT_EQ(mesh.cell_count(), 6 * 5 * 10);
    ASSERT_EQ(volumes.size(), 300);
    ASSERT_EQ(centres.size(), 900);
    double volume = 0, centroid = 0, warp = 0;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        auto const k = static_cast<std::size_t>(c);
        Vec3 const there(centres[3 * k], centres[3 * k + 1], centres[3 * k + 2]);
        volume = std::max(volume, std::abs(mesh.volume(c) / volumes[k] - 1));
        centroid = std::max(centroid, (mesh.centroid(c) - there).norm() / std::cbrt(volumes[k]));
    }
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
        warp = std::max(warp, mesh.face_warp(f) / std::sqrt(mesh.face_area(f)));
    figure("largest_volume_difference_from_openfoam", volume);
    figure("largest_centroid_difference_from_openfoam", centroid);
    EXPECT_LT(volume, 1e-10);
    EXPECT_LT(centroid, 1e-10);
    EXPECT_GT(warp, 0.01) << "faces that are flat prove less";
}

}  // namespace
}  // namespace gimdem::test

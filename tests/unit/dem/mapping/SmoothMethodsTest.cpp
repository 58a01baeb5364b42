// SPDX-License-Identifier: BSD-3-Clause
/// `kernel` and `diffusion`: what they make of one particle, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "CellMeshes.hpp"
#include "Mapped.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

/// Solid volume per cell of one sphere in cubes of the edge 1.
exec::Buffer<double> solid_of(PolyMesh const& mesh, std::string_view name, double bandwidth, Sphere const& sphere)
{
    MappingSettings settings = method(name);
    settings.bandwidth = bandwidth;
    return Mapped(mesh, settings, {sphere}).sums.solid_volume;
}

/// Mean of (x - x_p)^2 along each axis, weighted with the solid.
Vec3 variance(PolyMesh const& mesh, exec::Buffer<double> const& solid, Vec3 const& centre)
{
    Vec3 sum = Vec3::Zero();
    double total = 0;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        sum += solid[c] * (mesh.centroid(c) - centre).cwiseAbs2();
        total += solid[c];
    }
    return sum / total;
}

TEST(GaussianKernel, IsAGaussianOfTheDistance)
{
    PolyMesh const mesh(hexahedra(9, {1, 1, 1}).mesh());
    Vec3 const x(4.3, 4.6, 4.5);
    double const r = 0.4, bandwidth = 1.3, b = 2 * r * bandwidth;
    auto const solid = solid_of(mesh, "kernel", bandwidth, {x, r});
    auto const at = [](int i, int j, int k) { return i + 9 * (j + 9 * k); };
    double const own = solid[at(4, 4, 4)];
    double const mu2 = (Vec3(4.5, 4.5, 4.5) - x).squaredNorm();
    for (Vec3 const& cell : {Vec3(5, 4, 4), Vec3(3, 5, 4), Vec3(4, 4, 6)})
    {
        double const expected = std::exp((mu2 - (cell + Vec3(0.5, 0.5, 0.5) - x).squaredNorm()) / (b * b));
        EXPECT_NEAR(solid[at(int(cell.x()), int(cell.y()), int(cell.z()))] / own, expected, 1e-13);
    }
    EXPECT_EQ(solid[at(8, 4, 4)], 0);  // beyond 3 b
}

TEST(GaussianKernel, WeighsCellsByTheirVolume)
{
    // Of the same Gaussian the cells of a stretched lattice get densities that depend on the distance alone.
    PolyMesh const mesh(hexahedra(9, {1, 1, 0.5}).mesh());
    auto const solid = solid_of(mesh, "kernel", 2, {{4.5, 4.5, 2.25}, 0.4});
    auto const at = [](int i, int j, int k) { return i + 9 * (j + 9 * k); };
    EXPECT_NEAR(solid[at(5, 4, 4)], solid[at(4, 4, 6)], 1e-15);
}

TEST(Diffusion, SpreadsAPointToTheVarianceOfTheKernel)
{
    int const n = 21;
    PolyMesh const mesh(hexahedra(n, {1, 1, 1}).mesh());
    Vec3 const middle = Vec3::Constant(n / 2 + 0.5);
    double const r = 0.45, bandwidth = 1.7, b = 2 * r * bandwidth;
    auto const solid = solid_of(mesh, "diffusion", bandwidth, {middle, r});
    // On a lattice implicit Euler steps keep the growth of the variance, 2 for each tau, exactly; what reaches the
    // boundary after seven lengths b is below 1e-4 of the particle.
    Vec3 const v = variance(mesh, solid, middle);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(v[axis] / (b * b / 2), 1, 1e-3);
    double total = 0;
    for (double const s : solid.host())
    {
        EXPECT_GE(s, -1e-16);
        total += s;
    }
    EXPECT_NEAR(total / sphere_volume(r), 1, 1e-14);
}

TEST(Diffusion, LeavesAUniformFieldAlone)
{
    PolyMesh const mesh(voronoi_cells(4, {1, 1, 1}).mesh());
    // A particle at each centroid, as large as its cell asks for: the same solid fraction everywhere.
    std::vector<Sphere> spheres;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        spheres.push_back({mesh.centroid(c), std::cbrt(0.3 * mesh.volume(c) * 3 / (4 * M_PI))});
    Mapped const mapped(mesh, method("diffusion"), spheres);
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        EXPECT_NEAR(mapped.sums.solid_volume[c] / mesh.volume(c), 0.3, 1e-12);
}

TEST(Diffusion, PassesNothingThroughWalls)
{
    // A wide bandwidth in a small box: everything becomes uniform.
    PolyMesh const mesh(hexahedra(4, {1, 1, 1}).mesh());
    auto const solid = solid_of(mesh, "diffusion", 200, {{0.5, 0.5, 0.5}, 0.4});
    for (double const s : solid.host())
        EXPECT_NEAR(s / (sphere_volume(0.4) / 64), 1, 1e-6);
}

}  // namespace

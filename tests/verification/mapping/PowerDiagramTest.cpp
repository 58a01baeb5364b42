// SPDX-License-Identifier: BSD-3-Clause
/// `power-diagram` against the exact overlap, beside `gim`, on meshes that none of its constants was fitted on.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "CellMeshes.hpp"
#include "Figure.hpp"
#include "WrongShare.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr std::string_view both[] = {"power-diagram", "gim"};

std::string figure_name(std::string_view what, std::string_view method, std::string_view where)
{
    std::string name = fmt::format("{}_{}_on_{}", what, method, where);
    std::ranges::replace(name, '-', '_');
    return name;
}

/// Radius of spheres that are `ratio` times smaller than cubes of the cells' mean volume.
double radius_at(PolyMesh const& mesh, double ratio)
{
    return 0.5 / ratio * std::cbrt((mesh.high() - mesh.low()).prod() / mesh.cell_count());
}

struct Mesh
{
    char const* name;
    CellList cells;
    double wrong[4];  ///< at the ratios below
};
constexpr double ratios[4] = {0.5, 1, 1.76, 3};

TEST(PowerDiagram, PutsFewIntoWrongCellsOfAnyMesh)
{
    Mesh const meshes[] = {
        {"cubes", hexahedra(9, {1, 1, 1}), {0.0375, 0.0147, 0.00672, 0.00278}},
        {"hexahedra_1_to_2", hexahedra(9, {1, 1, 2}), {0.0532, 0.0145, 0.00699, 0.00300}},
        {"hexahedra_1_to_4", hexahedra(9, {1, 1, 4}), {0.0655, 0.0169, 0.00800, 0.00349}},
        {"warped_hexahedra", shaken(hexahedra(9, {1, 1, 1}), 0.2, 31), {0.0712, 0.0376, 0.0328, 0.0365}},
        {"tetrahedra", shaken(tetrahedra(6, {1, 1, 1}), 0.25, 32), {0.167, 0.0819, 0.0398, 0.0227}},
        {"voronoi_cells", voronoi_cells(8, {8, 8, 8}, 33), {0.0885, 0.0612, 0.0380, 0.0315}},
        {"voronoi_cells_1_to_2", voronoi_cells(8, {8, 8, 16}, 34), {0.166, 0.0868, 0.0520, 0.0422}},
    };
    for (Mesh const& tried : meshes)
    {
        PolyMesh const mesh(tried.cells.mesh());
        for (int k = 0; k < 4; ++k)
        {
            double const r = radius_at(mesh, ratios[k]);
            auto const spheres = random_spheres(2000, mesh.low(), mesh.high(), r, r, 35);
            auto const exact = weights_of_all(mesh, "exact", spheres);
            double wrong[2];
            for (int m = 0; m < 2; ++m)
            {
                wrong[m] = share_apart(mesh.cell_count(), weights_of_all(mesh, both[m], spheres), exact);
                figure(fmt::format("{}_at_{}", figure_name("wrong_cells", both[m], tried.name), ratios[k]), wrong[m]);
            }
            // Measured here. Other places of the spheres change these numbers by a twentieth.
            EXPECT_NEAR(wrong[0] / tried.wrong[k], 1, 0.1) << tried.name << " at a/dp = " << ratios[k];
            EXPECT_LT(wrong[0], wrong[1] * (ratios[k] < 1 ? 0.6 : 0.3));
        }
    }
}

/// A loose bed: a lattice of spheres 1.08 diameters apart, each moved by up to 0.04 of a diameter along each axis,
/// which none overlaps another by. A layer of a cell's size is left free at the sides.
std::vector<Sphere> loose_bed(PolyMesh const& mesh, double radius)
{
    std::mt19937_64 random(36);
    std::uniform_real_distribution<double> uniform(-0.08 * radius, 0.08 * radius);
    double const apart = 2.16 * radius;
    std::vector<Sphere> spheres;
    Vec3 const room = mesh.high() - mesh.low();
    Eigen::Vector3i const n = (room / apart).cast<int>();
    for (int i = 0; i < n.prod(); ++i)
    {
        Vec3 const place(i % n[0] + 0.5, i / n[0] % n[1] + 0.5, i / n[0] / n[1] + 0.5);
        spheres.push_back(
            {mesh.low() + apart * place + Vec3(uniform(random), uniform(random), uniform(random)), radius});
    }
    return spheres;
}

/// Largest change of a cell's solid fraction while one sphere goes along a line by hundredths of its diameter.
double largest_jump(PolyMesh const& mesh, std::string_view name, double radius)
{
    std::vector<Sphere> places;
    Vec3 const from = 0.9 * mesh.low() + 0.1 * mesh.high(), to = 0.12 * mesh.low() + 0.88 * mesh.high();
    int const steps = static_cast<int>((to - from).norm() / (0.02 * radius));
    Vec3 const way = 0.02 * radius * (to - from + Vec3(0.3, -0.2, 0.1)).normalized();
    for (int i = 0; i < steps; ++i)
        places.push_back({from + i * way, radius});
    auto const weights = weights_of_all(mesh, name, places);
    double largest = 0;
    for (std::size_t i = 0; i + 1 < places.size(); ++i)
    {
        auto change = solid_fractions(mesh, {weights[i]}, radius);
        auto const next = solid_fractions(mesh, {weights[i + 1]}, radius);
        for (std::size_t c = 0; c < change.size(); ++c)
            largest = std::max(largest, std::abs(next[c] - change[c]));
    }
    return largest;
}

TEST(PowerDiagram, SolidFractionsOfABedAreNearTheExactAndSmooth)
{
    struct Expected
    {
        char const* name;
        CellList cells;
        double error, most, jump;
    };
    Expected const meshes[] = {{"cubes", hexahedra(8, {1, 1, 1}), 0.00512, 0.623, 0.00143},
                               {"hexahedra_1_to_4", hexahedra(8, {1, 1, 4}), 0.000995, 0.430, 0.00117},
                               {"voronoi_cells", voronoi_cells(8, {8, 8, 8}, 33), 0.0112, 0.505, 0.00205}};
    for (Expected const& tried : meshes)
    {
        PolyMesh const mesh(tried.cells.mesh());
        double const r = radius_at(mesh, 1.76);
        auto const spheres = loose_bed(mesh, r);
        auto const exact = solid_fractions(mesh, weights_of_all(mesh, "exact", spheres), r);
        figure(figure_name("largest_solid_fraction", "exact", tried.name), std::ranges::max(exact));
        figure(figure_name("solid_fraction_jump", "exact", tried.name), largest_jump(mesh, "exact", r));
        double error[2], jump[2], most[2];
        for (int m = 0; m < 2; ++m)
        {
            auto const fractions = solid_fractions(mesh, weights_of_all(mesh, both[m], spheres), r);
            double sum = 0;
            for (std::size_t c = 0; c < exact.size(); ++c)
                sum += (fractions[c] - exact[c]) * (fractions[c] - exact[c]);
            error[m] = std::sqrt(sum / static_cast<double>(exact.size()));
            most[m] = std::ranges::max(fractions);
            jump[m] = largest_jump(mesh, both[m], r);
            figure(figure_name("solid_fraction_rms_error", both[m], tried.name), error[m]);
            figure(figure_name("largest_solid_fraction", both[m], tried.name), most[m]);
            figure(figure_name("solid_fraction_jump", both[m], tried.name), jump[m]);
        }
        // Measured here, with the scatter of other places.
        EXPECT_NEAR(error[0], tried.error, 0.1 * tried.error) << tried.name;
        EXPECT_NEAR(most[0], tried.most, 0.02) << tried.name;
        EXPECT_NEAR(jump[0], tried.jump, 0.1 * tried.jump) << tried.name;
    }
}

}  // namespace

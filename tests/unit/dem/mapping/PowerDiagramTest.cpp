// SPDX-License-Identifier: BSD-3-Clause
/// `power-diagram`: the potentials of the cells, and the limits and symmetries of the weights.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "CellMeshes.hpp"
#include "WrongShare.hpp"
#include "mapping/CellPotentials.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr std::string_view name = "power-diagram";

/// Part of a ball beyond a plane at u radii from its centre.
double cap(double u)
{
    return u >= 1 ? 0 : (1 - u) * (1 - u) * (2 + u) / 4;
}
/// Square of how large a ball of the radius r is against a cell, (G.38).
double size2(CellPotential const& cell, double r)
{
    return cell.narrowness * r * r;
}
/// What a cell has of a ball, of what that with the least potential has, (G.39).
double odds(double u, double size2)
{
    return cap(u) * (1 + 3 * size2 * size2) / (cap(-u) + 3 * size2 * size2 * cap(u));
}

TEST(CellPotentials, DifferByTheDistanceToTheFaceBetweenBoxes)
{
    struct Tried
    {
        Vec3 edges;
        double tolerance;
    };
    // The fit starts from cubes, whose potentials are exact, and stops after thirty steps.
    for (Tried const& tried : {Tried{{2, 2, 2}, 1e-13}, Tried{{1, 1, 2}, 5e-3}, Tried{{1, 1, 4}, 2e-2}})
    {
        PolyMesh const mesh(hexahedra(6, tried.edges).mesh());
        auto const potentials = fit_potentials(mesh);
        MeshKernelView const view = mesh.view();
        double worst = 0;
        for (std::int32_t f = 0; f < mesh.internal_face_count(); ++f)
            for (double const along : {-0.3, 0.0, 0.4})
            {
                Vec3 const x = mesh.face_centre(f) + along * mesh.face_normal(f);
                double const apart =
                    potentials[view.owner[f]](Quad::of(x, 0)) - potentials[view.neighbour[f]](Quad::of(x, 0));
                worst = std::max(worst, std::abs(apart - along));
            }
        EXPECT_LT(worst, tried.tolerance) << tried.edges.transpose();
    }
}

TEST(PowerDiagram, BallInsideItsCellGivesItAll)
{
    PolyMesh const mesh(hexahedra(5, {1, 1, 1}).mesh());
    auto const w = Mapped(mesh, method(name), {{{2.55, 2.5, 2.45}, 0.4}}).weights();
    ASSERT_EQ(w.size(), 1u);
    EXPECT_EQ(w.at(2 + 5 * (2 + 5 * 2)), 1);
}

TEST(PowerDiagram, BallAcrossAFaceIsCutInCaps)
{
    PolyMesh const mesh(hexahedra(5, {1, 1, 1}).mesh());
    for (double const r : {0.03, 0.3})
        for (double const outside : {-0.9, -0.3, 0.0, 0.5})
        {
            auto const w = Mapped(mesh, method(name), {{{3 + outside * r, 2.5, 2.45}, r}}).weights();
            ASSERT_EQ(w.size(), 2u);
            // What a ball's size adds, as in (G.38) and (G.39), is of the second order in r / a.
            double const tolerance = 0.3 * r * r;
            EXPECT_NEAR(w.at(2 + 5 * (2 + 5 * 2)), cap(outside), tolerance) << outside;
            EXPECT_NEAR(w.at(3 + 5 * (2 + 5 * 2)), cap(-outside), tolerance) << outside;
        }
}

TEST(PowerDiagram, CellsAroundAnEdgeOrACornerHaveEqualParts)
{
    PolyMesh const mesh(hexahedra(6, {1, 1, 1}).mesh());
    for (auto const& [place, cells] : {std::pair{Vec3(3, 3, 2.5), 4u}, std::pair{Vec3(3, 3, 3), 8u}})
    {
        auto const w = Mapped(mesh, method(name), {{place, 0.4}}).weights();
        ASSERT_EQ(w.size(), cells);
        for (auto const& [cell, weight] : w)
            EXPECT_NEAR(weight, 1.0 / cells, 1e-13);
    }
}

TEST(PowerDiagram, BallLargerThanItsCellIsSharedNearlyAsByTheOverlap)
{
    // A ball of eight times the cells' volume around the centre of one: a cell inside of it should have an eighth.
    PolyMesh const mesh(hexahedra(9, {1, 1, 1}).mesh());
    std::vector<Sphere> const ball{{{4.5, 4.5, 4.5}, std::cbrt(8 * 3 / (4 * std::numbers::pi))}};
    auto const exact = weights_of_all(mesh, "exact", ball);
    // Measured, with what the formulas' constants, of two digits, leave open. `gim` puts 0.35 into wrong cells.
    EXPECT_NEAR(share_apart(mesh.cell_count(), weights_of_all(mesh, name, ball), exact), 0.091, 0.01);
    EXPECT_GT(share_apart(mesh.cell_count(), weights_of_all(mesh, "gim", ball), exact), 0.3);
    auto const w = Mapped(mesh, method(name), ball).weights();
    std::int32_t const own = 4 + 9 * (4 + 9 * 4);
    for (std::int32_t const step : {-81, -9, -1, 1, 9, 81})
    {
        EXPECT_NEAR(w.at(own + step), w.at(own + 1), 1e-13);
        EXPECT_LT(w.at(own + step), w.at(own));
    }
}

/// Weights of spheres in Voronoi cells, and of the same when all is turned and `scale` times larger.
double turned_apart(Eigen::Matrix3d const& turn, double scale)
{
    CellList cells = voronoi_cells(4, {1, 1, 1}, 41);
    PolyMesh const mesh(cells.mesh());
    auto spheres = random_spheres(200, {0, 0, 0}, {1, 1, 1}, 0.05, 0.15);
    auto const before = weights_of_all(mesh, name, spheres);
    for (Vec3& x : cells.points)
        x = scale * turn * x;
    for (Sphere& s : spheres)
        s = {scale * turn * s.position, scale * s.radius};
    PolyMesh const turned(cells.mesh());
    return share_apart(mesh.cell_count(), weights_of_all(turned, name, spheres), before);
}

TEST(PowerDiagram, IsTheSameTurnedAndScaled)
{
    // Roundings of the fit, amplified by the condition of its equations.
    EXPECT_LT(turned_apart(Eigen::Matrix3d::Identity(), 1e-3), 1e-9);
    EXPECT_LT(turned_apart(Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()).toRotationMatrix(), 1), 1e-9);
}

/// By the definition, over all cells of the mesh.
std::vector<double> weights_over_all(exec::Buffer<CellPotential> const& potentials, Sphere const& s)
{
    std::vector<double> w;
    for (CellPotential const& q : potentials.host())
        w.push_back(q(Quad::of(s.position, 0)) / (s.radius * std::sqrt(1 + size2(q, s.radius))));
    double const least = std::ranges::min(w);
    double sum = 0;
    for (std::size_t c = 0; c < w.size(); ++c)
        sum += w[c] = odds(w[c] - least, size2(potentials[static_cast<std::int64_t>(c)], s.radius));
    for (double& u : w)
        u /= sum;
    return w;
}

TEST(PowerDiagram, RowsHoldAllCellsThatReceive)
{
    for (CellList const& cells : {voronoi_cells(5, {1, 1, 1}, 42), shaken(tetrahedra(3, {1, 1, 1}), 0.2, 43),
                                  shaken(hexahedra(5, {1, 1, 2}), 0.2, 44)})
    {
        PolyMesh const mesh(cells.mesh());
        auto const potentials = fit_potentials(mesh);
        double const size = std::cbrt((mesh.high() - mesh.low()).prod() / mesh.cell_count());
        auto const spheres = random_spheres(300, mesh.low(), mesh.high(), 0.1 * size, 0.6 * size);
        auto const sparse = weights_of_all(mesh, name, spheres);
        for (std::size_t p = 0; p < spheres.size(); ++p)
        {
            auto w = weights_over_all(potentials, spheres[p]);
            for (auto const& [cell, weight] : sparse[p])
                w[static_cast<std::size_t>(cell)] -= weight;
            for (double const apart : w)
                EXPECT_NEAR(apart, 0, 1e-12);
        }
    }
}

}  // namespace

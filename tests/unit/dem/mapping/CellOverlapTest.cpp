// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/overlap/CellOverlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "CellMeshes.hpp"
#include "mesh/PolyMesh.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;
using overlap::BallOverlap;
using overlap::CellFacets;

constexpr double pi = std::numbers::pi;

/// A mesh with its facets.
struct Cells
{
    explicit Cells(CellList const& list) : mesh(list.mesh()), facets(mesh) {}

    double overlap(std::int32_t cell, Vec3 const& centre, double radius) const
    {
        return BallOverlap{facets.view(), centre, radius}(cell);
    }
    double overlap_with_all(Vec3 const& centre, double radius) const
    {
        double sum = 0;
        for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
            sum += overlap(c, centre, radius);
        return sum;
    }

    PolyMesh mesh;
    CellFacets facets;
};

/// Volume of a ball inside of a plane, h: from the centre to the plane, positive where the centre is inside.
double inside_plane(double radius, double h)
{
    return pi * (radius + h) * (radius + h) * (2 * radius - h) / 3;
}

// What a closed form and the sum of about ten terms of the size of the ball may differ by.
constexpr double rounding = 1e-14;

TEST(CellOverlap, OneFaceCutsACap)
{
    Cells const cube(hexahedra(1, {1, 1, 1}));
    double const r = 0.3;
    for (double h = -0.299; h < 0.3; h += 0.023)
    {
        double const expected = inside_plane(r, h);
        EXPECT_NEAR(cube.overlap(0, {0.5, 0.47, h}, r) / expected, 1, 1e-10) << h;
        EXPECT_NEAR(cube.overlap(0, {1 - h, 0.5, 0.52}, r), expected, rounding * sphere_volume(r)) << h;
    }
}

TEST(CellOverlap, CentreOnFaceEdgeAndCornerOfACube)
{
    Cells const cube(hexahedra(1, {1, 1, 1}));
    double const r = 0.4, whole = sphere_volume(r);
    EXPECT_NEAR(cube.overlap(0, {0.5, 0.5, 0}, r), whole / 2, rounding * whole);
    EXPECT_NEAR(cube.overlap(0, {1, 0.55, 0.5}, r), whole / 2, rounding * whole);
    EXPECT_NEAR(cube.overlap(0, {0, 0.5, 1}, r), whole / 4, rounding * whole);
    for (int corner = 0; corner < 8; ++corner)
        EXPECT_NEAR(cube.overlap(0, Vec3(corner & 1, corner >> 1 & 1, corner >> 2), r), whole / 8, rounding * whole);
}

TEST(CellOverlap, IsContinuousThroughFacesEdgesAndCorners)
{
    Cells const cube(hexahedra(1, {1, 1, 1}));
    double const r = 0.4, whole = sphere_volume(r);
    // The volume changes by less than the area of a disc, pi r^2, for each length of the way.
    for (double const step : {1e-17, 1e-15, 1e-12, 1e-9, 1e-6})
        for (int corner = 0; corner < 27; ++corner)
        {
            Vec3 const way = step * Vec3(corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1);
            double const tolerance = rounding * whole + 3 * pi * r * r * step;
            EXPECT_NEAR(cube.overlap(0, Vec3(0, 0, 0) + way, r), whole / 8, tolerance) << step << ' ' << corner;
            EXPECT_NEAR(cube.overlap(0, Vec3(0, 1, 0.5) + way, r), whole / 4, tolerance) << step << ' ' << corner;
            EXPECT_NEAR(cube.overlap(0, Vec3(0.5, 1, 0.5) + way, r), whole / 2, tolerance) << step << ' ' << corner;
        }
}

/// A prism of the height 4 over a triangle with the angle `angle` at the z axis.
CellList prism(double angle)
{
    CellList list;
    for (double const z : {-2.0, 2.0})
    {
        list.points.emplace_back(0, 0, z);
        list.points.emplace_back(4, 0, z);
        list.points.emplace_back(4 * std::cos(angle), 4 * std::sin(angle), z);
    }
    list.cells.push_back({{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}});
    return list;
}

TEST(CellOverlap, WedgeThroughTheCentre)
{
    double const r = 0.7;
    for (double const angle : {0.01, 0.3, 1.0, 1.9, 2.6})
        EXPECT_NEAR(Cells(prism(angle)).overlap(0, {0, 0, 0.1}, r) / (sphere_volume(r) * angle / (2 * pi)), 1, 1e-10)
            << angle;
}

/// Volume of a ball of radius 1 with x < u and y < v by Gauss' rule over x, in pieces: x = -1 + w^2 or u - w^2.
double inside_two_planes(double u, double v)
{
    // Area of the disc of radius q with y < v.
    auto const area = [&](double q2)
    {
        if (q2 <= 0) return 0.0;
        double const q = std::sqrt(q2), s = std::clamp(v / q, -1.0, 1.0);
        return q2 * (pi / 2 + std::asin(s) + s * std::sqrt(1 - s * s));
    };
    // The disc's size is a smooth function of theta, x = -cos theta, but where it begins to be cut.
    std::vector<double> breaks{0, std::acos(-std::clamp(u, -1.0, 1.0))};
    if (std::abs(v) < 1)
        for (double const x : {-std::sqrt(1 - v * v), std::sqrt(1 - v * v)})
            if (x < u) breaks.push_back(std::acos(-x));
    std::ranges::sort(breaks);
    double sum = 0;
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    {
        // Substitution theta = middle + half sin(pi t / 2): flat ends take the roots' singularities away.
        double const middle = (breaks[k] + breaks[k + 1]) / 2, half = (breaks[k + 1] - breaks[k]) / 2;
        int const n = 400;
        for (int i = 0; i < n; ++i)
        {
            double const t = std::tanh(1.5707963267948966 * std::sinh(-3.2 + 6.4 * (i + 0.5) / n));
            double const s = -3.2 + 6.4 * (i + 0.5) / n;
            double const dt = 1.5707963267948966 * std::cosh(s) * (1 - t * t) * 6.4 / n;
            double const theta = middle + half * t;
            sum += area(std::sin(theta) * std::sin(theta)) * std::sin(theta) * half * dt;
        }
    }
    return sum;
}

TEST(CellOverlap, TwoPlanesAtAnyDistances)
{
    Cells const cube(hexahedra(1, {8, 8, 8}));
    for (double const u : {-0.7, -0.2, 0.0, 0.005, 0.3, 0.69, 0.95})
        for (double const v : {-0.69, -0.1, 0.0, 0.004, 0.2, 0.6, 0.72})
        {
            double const expected = inside_two_planes(u, v);
            EXPECT_NEAR(cube.overlap(0, {u, v, 4}, 1), expected, 1e-10 * expected + 1e-14) << u << ' ' << v;
        }
}

TEST(CellOverlap, BallInsideAroundAndTangent)
{
    Cells const cube(hexahedra(1, {1, 2, 3}));
    EXPECT_EQ(cube.overlap(0, {0.5, 1, 1.5}, 0.4), sphere_volume(0.4));
    EXPECT_EQ(cube.overlap(0, {0.5, 1, 1.5}, 0.5), sphere_volume(0.5));
    EXPECT_NEAR(cube.overlap(0, {0.3, 1.3, 0.5}, 4), 6, rounding * sphere_volume(4));
    EXPECT_NEAR(cube.overlap(0, {-0.3, -0.3, 0.5}, 5), 6, rounding * sphere_volume(5));
    EXPECT_NEAR(cube.overlap(0, {-0.5, 1, 1.5}, 0.5), 0, rounding);     // touches a face from outside
    EXPECT_NEAR(cube.overlap(0, {-0.3, -0.4, 1.5}, 0.5), 0, rounding);  // an edge
    EXPECT_NEAR(cube.overlap(0, {-1, -2, -2}, 3), 0, 27 * rounding);    // a corner
    EXPECT_NEAR(cube.overlap(0, {-5, 1, 1.5}, 0.5), 0, rounding);
}

TEST(CellOverlap, DecompositionsOfACellAgree)
{
    // A cube as one cell, as six tetrahedra and as eight cubes; a shaken block as hexahedra and by its facets' cones.
    Cells const one(hexahedra(1, {1, 1, 1})), six(tetrahedra(1, {1, 1, 1})), eight(hexahedra(2, {0.5, 0.5, 0.5}));
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> place(-0.3, 1.3), size(0.05, 1.2);
    for (int i = 0; i < 2000; ++i)
    {
        Vec3 x(place(random), place(random), place(random));
        double const r = size(random);
        // Every fifth ball sits on planes of the decompositions.
        if (i % 5 == 0) x = Vec3(std::round(2 * x[0]) / 2, std::round(2 * x[1]) / 2, i % 2 == 0 ? x[2] : x[1]);
        double const expected = one.overlap(0, x, r);
        ASSERT_NEAR(six.overlap_with_all(x, r), expected, 10 * rounding * sphere_volume(r))
            << x.transpose() << ' ' << r;
        ASSERT_NEAR(eight.overlap_with_all(x, r), expected, 10 * rounding * sphere_volume(r))
            << x.transpose() << ' ' << r;
        ASSERT_NEAR((BallOverlap{one.facets.view(), x, r}.sum_of_cones(0)), expected, rounding * sphere_volume(r))
            << x.transpose() << ' ' << r;
    }
}

/// Sum over the cells and the row's way of it, for balls inside the mesh.
void expect_whole_balls(CellList const& list, Vec3 const& size, double radius, int count)
{
    Cells const cells(list);
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Vec3> centres;
    for (int i = 0; i < count; ++i)
        centres.emplace_back(uniform(random), uniform(random), uniform(random));
    // Centres, points and centres of faces of the mesh itself.
    for (Vec3& x : centres)
        x = Vec3::Constant(radius) + x.cwiseProduct(size - Vec3::Constant(2 * radius));
    for (Vec3 const& x : list.points)
        centres.push_back(x);
    for (std::int32_t f = 0; f < cells.mesh.face_count(); ++f)
        centres.push_back(cells.mesh.face_centre(f));
    for (std::int32_t c = 0; c < cells.mesh.cell_count(); ++c)
        centres.push_back(cells.mesh.centroid(c));
    for (Vec3 const& x : centres)
    {
        if ((x - Vec3::Constant(radius)).minCoeff() < 0 || (size - x - Vec3::Constant(radius)).minCoeff() < 0) continue;
        ASSERT_NEAR(cells.overlap_with_all(x, radius) / sphere_volume(radius), 1, 1e-12) << x.transpose();
    }
}

TEST(CellOverlap, CellsOfAMeshShareTheWholeBall)
{
    Vec3 const cube(1, 1, 1);
    for (double const radius : {0.02, 0.09, 0.2, 0.45})
    {
        expect_whole_balls(hexahedra(4, cube / 4), cube, radius, 300);
        expect_whole_balls(hexahedra(4, {0.25, 0.5, 1}), {1, 2, 4}, radius, 300);
        expect_whole_balls(tetrahedra(3, cube / 3), cube, radius, 200);
        expect_whole_balls(voronoi_cells(4, cube), cube, radius, 200);
        expect_whole_balls(shaken(hexahedra(4, cube / 4), 0.2), cube, radius, 300);
    }
}

TEST(CellOverlap, CellFarFromTheOriginIsAsExact)
{
    // A cell of a millimetre half a metre from the origin.
    CellList list = hexahedra(1, {1e-3, 1e-3, 1e-3});
    for (Vec3& x : list.points)
        x += Vec3(0.5, 0.25, 0.5);
    double const r = 0.3e-3;
    EXPECT_NEAR(Cells(list).overlap(0, {0.5 + 0.1e-3, 0.2505, 0.5005}, r) / inside_plane(r, 0.1e-3), 1, 1e-12);
}

/// A closed surface of triangles around the origin with random radii: not convex, its faces too.
CellList random_star(unsigned seed)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> radius(0.25, 1);
    CellList list;
    // An octahedron with each face split into four.
    std::vector<Vec3> const corners{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    list.points = corners;
    std::map<std::pair<int, int>, int> middles;
    auto const middle = [&](int a, int b)
    {
        auto const [at, is_new] =
            middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(list.points.size()));
        if (is_new)
            list.points.push_back(
                (corners[static_cast<std::size_t>(a)] + corners[static_cast<std::size_t>(b)]).normalized());
        return at->second;
    };
    std::vector<CellList::Face> faces;
    for (int k = 0; k < 4; ++k)
        for (int const pole : {4, 5})
        {
            int const a = pole == 4 ? k : (k + 1) % 4, b = pole == 4 ? (k + 1) % 4 : k;
            int const ab = middle(a, b), bp = middle(b, pole), pa = middle(pole, a);
            faces.insert(faces.end(), {{a, ab, pa}, {b, bp, ab}, {pole, pa, bp}, {ab, bp, pa}});
        }
    for (Vec3& x : list.points)
        x *= radius(random);
    list.cells.push_back(faces);
    return list;
}

/// Whether a point is inside of a closed surface of triangles: crossings of a ray along an odd direction.
bool is_inside(CellList const& list, Vec3 const& x)
{
    Vec3 const way(0.317, 0.619, 0.719);
    bool inside = false;
    for (auto const& face : list.cells[0])
    {
        auto const corner = [&](std::size_t k) { return list.points[static_cast<std::size_t>(face[k])]; };
        Vec3 const a = corner(0) - x, u = corner(1) - corner(0), v = corner(2) - corner(0);
        double const det = way.cross(v).dot(u);
        double const s = -a.dot(way.cross(v)) / det;
        double const t = -way.dot(a.cross(u)) / det;
        double const along = -v.dot(a.cross(u)) / det;
        if (s >= 0 && t >= 0 && s + t <= 1 && along > 0) inside = !inside;
    }
    return inside;
}

TEST(CellOverlap, RandomPolyhedraAgreeWithSampling)
{
    std::mt19937_64 random(17);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0, 1);
    for (unsigned seed = 0; seed < 8; ++seed)
    {
        CellList const list = random_star(seed);
        Cells const cell(list);
        Vec3 const centre = 0.2 * Vec3(normal(random), normal(random), normal(random));
        double const r = 0.3 + 0.5 * uniform(random);
        int const n = 20'000;
        int hits = 0;
        for (int i = 0; i < n; ++i)
        {
            Vec3 const way = Vec3(normal(random), normal(random), normal(random)).normalized();
            hits += is_inside(list, centre + r * std::cbrt(uniform(random)) * way);
        }
        double const share = double(hits) / n;
        double const exact = cell.overlap(0, centre, r) / sphere_volume(r);
        // Four standard deviations of the sampling, and one sample.
        EXPECT_NEAR(share, exact, 4 * std::sqrt(exact * (1 - exact) / n) + 1.0 / n) << seed;
        EXPECT_GT(exact, 0.01) << seed;
    }
}

TEST(CellOverlap, RowOfCellsIsTheSameAsCellByCell)
{
    Cells const cells(voronoi_cells(4, {1, 1, 1}));
    std::vector<std::int32_t> row(static_cast<std::size_t>(cells.mesh.cell_count()));
    std::vector<double> volumes(row.size());
    std::mt19937_64 random(19);
    std::uniform_real_distribution<double> uniform(0.15, 0.85);
    for (int i = 0; i < 200; ++i)
    {
        Vec3 const x(uniform(random), uniform(random), uniform(random));
        BallOverlap const ball{cells.facets.view(), x, 0.12};
        std::int32_t own = 0;
        for (std::int32_t c = 0; c < cells.mesh.cell_count(); ++c)
            if (ball.depth(c) > ball.depth(own)) own = c;
        for (std::size_t k = 0; k < row.size(); ++k)
            row[k] = static_cast<std::int32_t>(k);
        std::swap(row[0], row[static_cast<std::size_t>(own)]);
        overlap_with_row(ball, row.data(), static_cast<int>(row.size()), volumes.data());
        for (std::size_t k = 0; k < row.size(); ++k)
            ASSERT_NEAR(volumes[k], ball(row[k]), 2 * rounding * sphere_volume(0.12));
    }
}

}  // namespace

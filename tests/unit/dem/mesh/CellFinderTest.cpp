// SPDX-License-Identifier: BSD-3-Clause
/// The cell of a point in meshes whose cells are not convex or whose faces are not planar, (G.3a).
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "BoxMesh.hpp"
#include "CellMeshes.hpp"
#include "mesh/NearbyCells.hpp"
#include "mesh/PointLocator.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr int n = 6;

/// Unit cubes of an n^3 box put together into cells of any shape: `cell_of(i, j, k)`; -1: a hole.
struct CubeClusters
{
    std::vector<int> cell_of_cube;
    CellList list;

    template <class CellOf>
    explicit CubeClusters(CellOf cell_of)
    {
        std::vector<std::array<int, 8>> cubes;
        list = box_of(n, {1, 1, 1}, [&](std::array<int, 8> const& corners, CellList&) { cubes.push_back(corners); });
        for (int i = 0; i < n * n * n; ++i)
            cell_of_cube.push_back(cell_of(i % n, i / n % n, i / n / n));
        list.cells.resize(static_cast<std::size_t>(*std::ranges::max_element(cell_of_cube)) + 1);
        int const steps[6] = {-1, 1, -n, n, -n * n, n * n};
        for (int i = 0; i < n * n * n; ++i)
            for (std::size_t f = 0; f < 6; ++f)
                add_face(i, beside(i, f) ? i + steps[f] : -1, hexahedron(cubes[static_cast<std::size_t>(i)])[face[f]]);
    }

    int at(Vec3 const& x) const
    {
        return cell_of_cube[static_cast<std::size_t>(int(x.x()) + n * (int(x.y()) + n * int(x.z())))];
    }

private:
    static constexpr std::size_t face[6] = {0, 1, 2, 3, 4, 5};  // hexahedron() goes low x, high x, low y, ...

    static bool beside(int i, std::size_t f)
    {
        int const at[3] = {i % n, i / n % n, i / n / n};
        return f % 2 == 0 ? at[f / 2] > 0 : at[f / 2] < n - 1;
    }
    void add_face(int i, int other, CellList::Face const& points)
    {
        int const mine = cell_of_cube[static_cast<std::size_t>(i)];
        int const others = other < 0 ? -1 : cell_of_cube[static_cast<std::size_t>(other)];
        if (mine >= 0 && mine != others) list.cells[static_cast<std::size_t>(mine)].push_back(points);
    }
};

struct Finding
{
    explicit Finding(coupling::Mesh topology) : mesh(std::move(topology)), grid(cell_boxes(mesh)) {}

    Location operator()(std::int32_t last, Vec3 const& x) const
    {
        return CellFinder{mesh.view(), grid.view()}(last, x);
    }
    PolyMesh mesh;
    BoxGrid grid;
};

Vec3 random_point(std::mt19937_64& random)
{
    std::uniform_real_distribution<double> uniform(0, n);
    double const x = uniform(random), y = uniform(random);
    return {x, y, uniform(random)};
}

TEST(CellFinder, FindsPointsInCellsThatAreNotConvex)
{
    // Three cubes in an L: in the arms a point is beyond a plane of its own cell.
    CubeClusters const clusters(
        [](int i, int j, int k)
        {
            int const pair = 2 * (i / 2 + 3 * (j / 2 + 3 * k));
            return i % 2 == 1 && j % 2 == 1 ? pair + 1 : pair;
        });
    Finding const find(clusters.list.mesh());
    ASSERT_EQ(find.mesh.cell_count(), 2 * 9 * 6);
    std::mt19937_64 random(11);
    for (int i = 0; i < 2000; ++i)
    {
        Vec3 const x = random_point(random);
        for (std::int32_t const last : {-1, i % find.mesh.cell_count(), clusters.at(x)})
        {
            Location const at = find(last, x);
            ASSERT_EQ(at.cell, clusters.at(x)) << x.transpose() << " from " << last;
            ASSERT_EQ(at.face, -1);
        }
    }
}

TEST(CellFinder, FindsPointsAroundCornersOfTheMesh)
{
    // A wall with a gap at one end: straight ways from one side to the other end at the wall.
    CubeClusters clusters([](int i, int j, int k) { return j == 3 && i < 5 ? -1 : i + n * (j + n * k); });
    std::erase_if(clusters.list.cells, [](auto const& faces) { return faces.empty(); });
    Finding const find(clusters.list.mesh());
    ASSERT_EQ(find.mesh.cell_count(), n * n * n - 5 * n);
    std::mt19937_64 random(12);
    for (int i = 0; i < 2000; ++i)
    {
        Vec3 const x = random_point(random);
        if (clusters.at(x) < 0) continue;
        Location const at = find(i % find.mesh.cell_count(), x);
        ASSERT_EQ(at.face, -1) << x.transpose();
        ASSERT_LT((find.mesh.centroid(at.cell) - x).cwiseAbs().maxCoeff(), 0.5) << x.transpose();
    }
}

/// Whether x is in one of the tetrahedra between a cell's middle and its faces' triangles: for cells that their middle
/// sees all of, another way than solid angles.
bool in_a_tetrahedron(PolyMesh const& mesh, std::int32_t cell, Vec3 const& x)
{
    auto const side = [](Vec3 const& a, Vec3 const& b, Vec3 const& c, Vec3 const& d)
    { return (b - a).cross(c - a).dot(d - a); };
    Vec3 const top = mesh.centroid(cell);
    for (std::int32_t const f : mesh.faces_of_cell(cell))
    {
        auto const points = mesh.points_of_face(f);
        Vec3 middle = Vec3::Zero();
        for (std::int32_t const p : points)
            middle += mesh.point(p) / double(points.size());
        for (std::size_t k = 0; k < points.size(); ++k)
        {
            Vec3 const a = mesh.point(points[k]), b = mesh.point(points[(k + 1) % points.size()]);
            double const whole = side(a, b, middle, top);
            if (side(x, b, middle, top) / whole >= 0 && side(a, x, middle, top) / whole >= 0 &&
                side(a, b, x, top) / whole >= 0 && side(a, b, middle, x) / whole >= 0)
                return true;
        }
    }
    return false;
}

TEST(CellFinder, TakesWarpedFacesAsTheirTriangles)
{
    Finding const find(shaken(hexahedra(n, {1, 1, 1}), 0.15).mesh());
    std::mt19937_64 random(13);
    int uncertain = 0;
    for (int i = 0; i < 4000; ++i)
    {
        Vec3 const x = random_point(random);
        Location const at = find(-1, x);
        ASSERT_TRUE(in_a_tetrahedron(find.mesh, at.cell, x)) << x.transpose();
        for (int k = 1; k <= 5; ++k)
            ASSERT_EQ(find((i * k * 37) % find.mesh.cell_count(), x).cell, at.cell) << x.transpose();
        uncertain += !at.is_certain;
    }
    // Warp of 0.05 or so on either side of each of six faces: a large part of the points, not all of them.
    EXPECT_GT(uncertain, 400);
    EXPECT_LT(uncertain, 3000);
}

TEST(CellFinder, PointsOnFacesEdgesAndCornersAreOfTheLowestCellFromAnywhere)
{
    Finding const find(BoxMesh::make({n, n, n}, {n, n, n}));
    auto const number = [](int i, int j, int k) { return i + n * (j + n * k); };
    struct
    {
        Vec3 x;
        int cell;
    } const cases[] = {{{3, 2.5, 2.25}, number(2, 2, 2)}, {{3, 2.75, 4}, number(2, 2, 3)},
                       {{3, 2, 4}, number(2, 1, 3)},      {{0, 2.5, 2.5}, number(0, 2, 2)},
                       {{n, n, n}, number(5, 5, 5)},      {{0, 0, 3}, number(0, 0, 2)}};
    for (auto const& [x, cell] : cases)
        for (std::int32_t last = -1; last < find.mesh.cell_count(); ++last)
        {
            ASSERT_EQ(find(last, x).cell, cell) << x.transpose() << " from " << last;
            ASSERT_EQ(find(last, x).face, -1) << x.transpose() << " from " << last;
        }
}

TEST(CellFinder, CrossesManyCells)
{
    Finding const find(BoxMesh::make({3000, 1, 1}, {3000, 1, 1}));
    EXPECT_EQ(find(0, {2999.5, 0.5, 0.5}).cell, 2999);  // farther than a walk goes
    EXPECT_EQ(find(2999, {300.5, 0.5, 0.5}).cell, 300);
    EXPECT_EQ(find(0, {250.5, 0.5, 0.5}).cell, 250);
}

TEST(CellFinder, TellsWhereAPointLeftTheMesh)
{
    Finding const find(shaken(hexahedra(n, {1, 1, 1}), 0.15).mesh());
    for (std::int32_t last = -1; last < find.mesh.cell_count(); ++last)
    {
        Location const at = find(last, {2.5, 3.5, n + 0.25});
        ASSERT_NEAR(at.outside, 0.25, 1e-12);  // the box's surface is flat
        ASSERT_GE(at.face, find.mesh.internal_face_count());
        ASSERT_LT((find.mesh.face_normal(at.face) - Vec3(0, 0, 1)).norm(), 1e-12);
    }
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PolyMesh.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "BoxMesh.hpp"
#include "core/Error.hpp"
#include "mesh/NearbyCells.hpp"
#include "mesh/PointLocator.hpp"

namespace
{

using gimdem::CellLayers;
using gimdem::CellWalker;
using gimdem::PolyMesh;
using gimdem::Vec3;
using gimdem::test::BoxMesh;

/// The same box with its inner points moved and turned by an affine map, which keeps faces planar.
gimdem::coupling::Mesh sheared(gimdem::coupling::Mesh mesh)
{
    for (std::size_t p = 0; p < mesh.points.size(); p += 3)
    {
        Vec3 const x(mesh.points[p], mesh.points[p + 1], mesh.points[p + 2]);
        Vec3 const y(x.x() + 0.4 * x.z(), x.y() - 0.2 * x.x(), x.z() + 0.1 * x.y());
        for (int axis = 0; axis < 3; ++axis)
            mesh.points[p + static_cast<std::size_t>(axis)] = y[axis];
    }
    return mesh;
}

TEST(PolyMesh, VolumesAndCentroidsOfHexahedraAreExact)
{
    PolyMesh const mesh(BoxMesh::make({4, 3, 2}, {2, 1.5, 3}));
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        EXPECT_NEAR(mesh.volume(c), 0.375, 1e-15);
    EXPECT_LT((mesh.centroid(0) - Vec3(0.25, 0.25, 0.75)).norm(), 1e-15);
    // Volume of a sheared box: times the determinant of the map.
    PolyMesh const skew(sheared(BoxMesh::make({4, 3, 2}, {2, 1.5, 3})));
    Eigen::Matrix3d map;
    map << 1, 0, 0.4, -0.2, 1, 0, 0, 0.1, 1;
    EXPECT_NEAR(skew.volume(7), 0.375 * map.determinant(), 1e-14);
    EXPECT_LT((skew.centroid(0) - map * Vec3(0.25, 0.25, 0.75)).norm(), 1e-14);
}

TEST(PolyMesh, InsideOutCellIsRefusedByName)
{
    auto topology = BoxMesh::make({2, 1, 1}, {2, 1, 1});
    for (std::size_t p = 0; p < topology.points.size(); p += 3)
        topology.points[p] *= -1;
    try
    {
        PolyMesh const mesh(std::move(topology));
        FAIL() << "a mirrored mesh has negative volumes";
    }
    catch (gimdem::UserError const& error)
    {
        EXPECT_NE(std::string(error.what()).find("cell 0"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("must be positive"), std::string::npos) << error.what();
    }
}

TEST(CellLayers, HexahedronHasSixAndEighteenNeighbours)
{
    PolyMesh const mesh(BoxMesh::make({7, 7, 7}, {1, 1, 1}));
    CellLayers const layers(mesh);
    auto const middle = 3 + 7 * (3 + 7 * 3);
    EXPECT_EQ(layers.offsets[middle + 1] - layers.offsets[middle], 1 + 6 + 18);
    std::set<std::int32_t> cells;
    for (auto k = layers.offsets[middle]; k < layers.offsets[middle + 1]; ++k)
        cells.insert(layers.cells[k]);
    EXPECT_EQ(cells.size(), 25u);
    EXPECT_EQ(layers.cells[layers.offsets[middle]], middle);
    EXPECT_FALSE(cells.contains(middle + 1 + 7 + 49));  // shares a corner only
    EXPECT_TRUE(cells.contains(middle + 1 + 7));        // shares an edge
    EXPECT_TRUE(cells.contains(middle + 2));
    EXPECT_EQ(layers.offsets[1] - layers.offsets[0], 1 + 3 + 6);  // a corner cell
}

TEST(CellWalker, FindsTheCellOfAnyPointFromAnyStart)
{
    PolyMesh const mesh(sheared(BoxMesh::make({9, 5, 7}, {1, 1, 1})));
    gimdem::BoxGrid const grid(gimdem::cell_boxes(mesh));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    CellWalker const walk{mesh.view()};
    for (int i = 0; i < 2000; ++i)
    {
        Vec3 const x(uniform(random), uniform(random), uniform(random));
        Vec3 const y(x.x() + 0.4 * x.z(), x.y() - 0.2 * x.x(), x.z() + 0.1 * x.y());
        auto const expected = static_cast<std::int32_t>(x.x() * 9) +
                              9 * (static_cast<std::int32_t>(x.y() * 5) + 5 * static_cast<std::int32_t>(x.z() * 7));
        EXPECT_EQ(walk(grid.view().near(y), y).cell, expected);
        EXPECT_EQ(walk(i % mesh.cell_count(), y).cell, expected);
        EXPECT_EQ(walk(grid.view().near(y), y).face, -1);
    }
}

TEST(CellWalker, TellsHowFarAPointIsOutsideAndWhere)
{
    PolyMesh const mesh(BoxMesh::make({4, 4, 4}, {1, 1, 1}));
    auto const at = CellWalker{mesh.view()}(0, Vec3(0.6, 0.1, 1.25));
    EXPECT_EQ(at.cell, 2 + 4 * (0 + 4 * 3));
    EXPECT_NEAR(at.outside, 0.25, 1e-15);
    EXPECT_GE(at.face, mesh.internal_face_count());
    EXPECT_LT((mesh.face_normal(at.face) - Vec3(0, 0, 1)).norm(), 1e-15);
}

}  // namespace

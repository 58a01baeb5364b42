// SPDX-License-Identifier: BSD-3-Clause
#include "output/CellTopology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "Meshes.hpp"
#include "Vectors.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;
using output::CellFaces;
using output::CellTopology;
using output::hexahedron_of;

/// The unit cube by faces with outward normals; point number i + 2 j + 4 k is (i, j, k).
CellFaces const cube = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
std::vector<double> const cube_points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};

/// Determinant of the edges that leave corner `i` of a VTK hexahedron: 1 for a unit cube the right way round.
double corner_volume(std::array<std::int32_t, 8> const& hexahedron, std::size_t i)
{
    std::size_t const base = i < 4 ? 0 : 4;
    auto const at = [&](std::size_t place) { return point_at(cube_points, hexahedron[place]); };
    Vector const next = at(base + (i + 1) % 4) - at(i);
    Vector const previous = at(base + (i + 3) % 4) - at(i);
    Vector const across = at((i + 4) % 8) - at(i);
    return dot(cross(next, previous), across) * (i < 4 ? 1 : -1);
}

TEST(HexahedronOf, HasPositiveVolumeAtEveryCornerHoweverTheFacesAreListed)
{
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial)
    {
        CellFaces faces = cube;
        std::shuffle(faces.begin(), faces.end(), random);
        for (auto& face : faces)
            std::rotate(face.begin(), face.begin() + static_cast<long>(random() % 4), face.end());

        auto const hexahedron = hexahedron_of(faces);

        ASSERT_TRUE(hexahedron.has_value());
        for (std::size_t corner = 0; corner < 8; ++corner)
            EXPECT_EQ(corner_volume(*hexahedron, corner), 1) << "trial " << trial << " corner " << corner;
    }
}

TEST(HexahedronOf, RefusesOtherShapes)
{
    CellFaces const prism = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    CellFaces with_hanging_point = cube;
    with_hanging_point[0].insert(with_hanging_point[0].begin() + 1, 8);
    // six quadrilaterals that do not close to a box
    CellFaces twisted = cube;
    std::swap(twisted[1][0], twisted[1][1]);
    twisted[2] = {0, 1, 4, 5};
    twisted[3] = {2, 6, 3, 7};

    EXPECT_FALSE(hexahedron_of(prism).has_value());
    EXPECT_FALSE(hexahedron_of(with_hanging_point).has_value());
    EXPECT_TRUE(hexahedron_of(cube).has_value());
    EXPECT_FALSE(hexahedron_of({cube[0], cube[0], cube[1], cube[1], cube[2], cube[3]}).has_value());
}

TEST(CellTopology, BlockBecomesHexahedraOnly)
{
    CellTopology const cells(Block(3, 2, 4).mesh());

    EXPECT_EQ(cells.types, std::vector<std::uint8_t>(24, CellTopology::hexahedron));
    EXPECT_EQ(cells.connectivity.size(), 24u * 8u);
    EXPECT_EQ(cells.offsets.back(), 24 * 8);
    EXPECT_TRUE(cells.faces.empty());
}

TEST(CellTopology, PolyhedronHasOutwardFacesAroundItsVolume)
{
    auto const mesh = pair_and_cube();

    CellTopology const cells(mesh);

    ASSERT_EQ(cells.types, (std::vector<std::uint8_t>{CellTopology::polyhedron, CellTopology::hexahedron}));
    EXPECT_EQ(cells.offsets, (std::vector<std::int64_t>{12, 20}));
    EXPECT_EQ(cells.face_offsets, (std::vector<std::int64_t>{static_cast<std::int64_t>(cells.faces.size()), -1}));
    ASSERT_EQ(cells.faces[0], 10);
    double volume = 0;
    std::size_t at = 1;
    for (int face = 0; face < 10; ++face)
    {
        auto const begin = cells.faces.begin() + static_cast<long>(at) + 1;
        std::vector<std::int64_t> const points(begin, begin + cells.faces[at]);
        at += 1 + points.size();
        volume += volume_under(points, mesh.points);
        Vector const normal = cross(point_at(mesh.points, points[1]) - point_at(mesh.points, points[0]),
                                    point_at(mesh.points, points[2]) - point_at(mesh.points, points[0]));
        EXPECT_GT(dot(normal, point_at(mesh.points, points[0]) - Vector{1, 0.5, 0.5}), 0) << "face " << face;
    }
    EXPECT_EQ(at, cells.faces.size());
    EXPECT_NEAR(volume, 2, 1e-14);  // 10 faces of rounded products
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "message/MeshCheck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "BoxMesh.hpp"
#include "message/MeshMessage.hpp"

namespace gimdem::coupling::message
{
namespace
{

/// 24 cells, 60 points, 98 faces of which 46 are internal.
Mesh good_mesh()
{
    return test::BoxMesh::make({2, 3, 4}, {0.2, 0.3, 0.4});
}

TEST(MeshCheck, FindsNothingWrongWithABox)
{
    Mesh const mesh = good_mesh();
    ASSERT_EQ(mesh.owner.size(), 98u);
    ASSERT_EQ(mesh.neighbour.size(), 46u);
    EXPECT_EQ(find_mesh_fault(view_of(mesh)), std::nullopt);
    EXPECT_EQ(find_mesh_fault(view_of(test::BoxMesh::make({1, 1, 1}, {1, 1, 1}))), std::nullopt);
}

struct Damage
{
    std::string name;
    std::function<void(Mesh&)> apply;
    std::string text;
};

class DamagedMesh : public testing::TestWithParam<Damage>
{
};

TEST_P(DamagedMesh, IsDescribed)
{
    Mesh mesh = good_mesh();

    GetParam().apply(mesh);

    EXPECT_THAT(find_mesh_fault(view_of(mesh)).value_or("(nothing wrong)"), testing::HasSubstr(GetParam().text));
}

double constexpr nan = std::numeric_limits<double>::quiet_NaN();

std::vector<Damage> const damages{
    {"NoCells", [](Mesh& m) { m.cell_count = 0; }, "0 cells"},
    {"NegativeCells", [](Mesh& m) { m.cell_count = -3; }, "-3 cells"},
    {"ManyCells", [](Mesh& m) { m.cell_count = std::numeric_limits<std::int32_t>::max(); }, "only 98 faces"},
    {"EmptyMesh", [](Mesh& m) { m = Mesh(); }, "0 cells"},
    {"HalfAPoint", [](Mesh& m) { m.points.pop_back(); }, "179 numbers (3 for each point)"},
    {"NanPoint", [](Mesh& m) { m.points[10] = nan; }, "point 3 is not finite"},
    {"NoOffsets", [](Mesh& m) { m.face_offsets.clear(); }, "face_offsets has 0 numbers"},
    {"ShortOffsets", [](Mesh& m) { m.face_offsets.pop_back(); }, "face_offsets has 98 numbers"},
    {"OffsetStart", [](Mesh& m) { m.face_offsets[0] = 1; }, "begins with 1"},
    {"OffsetsFall", [](Mesh& m) { m.face_offsets[5] = 2; }, "face 4 has the offsets 16 to 2"},
    {"OffsetsOverflow", [](Mesh& m) { m.face_offsets[5] = std::numeric_limits<std::int32_t>::max(); }, "face 5 has"},
    {"FaceOfTwoPoints", [](Mesh& m) { m.face_offsets[1] = 2; }, "face 0 has the offsets 0 to 2"},
    {"OffsetEnd", [](Mesh& m) { m.face_points.push_back(0); }, "ends with 392 (face_points has 393"},
    {"PointTooLarge", [](Mesh& m) { m.face_points[7] = 60; }, "face_points[7] names point 60 (the mesh has 60)"},
    {"PointNegative", [](Mesh& m) { m.face_points[7] = -1; }, "face_points[7] names point -1"},
    {"OwnerTooLarge", [](Mesh& m) { m.owner[97] = 24; }, "owner[97] names cell 24 (the mesh has 24)"},
    {"OwnerNegative", [](Mesh& m) { m.owner[0] = -1; }, "owner[0] names cell -1"},
    {"NeighbourTooLarge", [](Mesh& m) { m.neighbour[45] = 24; }, "neighbour[45] names cell 24"},
    {"NeighbourIsOwner", [](Mesh& m) { m.neighbour[3] = m.owner[3]; }, "face 3 has cell"},
    {"MoreNeighboursThanFaces", [](Mesh& m) { m.neighbour.resize(99); }, "neighbour has 99 numbers"},
    {"CellWithoutFaces", [](Mesh& m) { m.cell_count = 25; }, "cell 24 has 0 faces"},
    {"PatchGap", [](Mesh& m) { ++m.patches[2].start_face; }, "patch \"front\" starts at face"},
    {"PatchBeforeBoundary", [](Mesh& m) { m.patches[0].start_face = 0; }, "starts at face 0 instead of 46"},
    {"PatchTooLong", [](Mesh& m) { m.patches.back().face_count += 1; }, "end at face 99"},
    {"PatchTooShort", [](Mesh& m) { m.patches.back().face_count -= 1; }, "end at face 97"},
    {"PatchNegative", [](Mesh& m) { m.patches[1].face_count = -1; }, "has -1 faces"},
    {"PatchOverflow", [](Mesh& m) { m.patches[0].face_count = std::numeric_limits<std::int32_t>::max(); }, "starts at"},
    {"PatchTwice", [](Mesh& m) { m.patches[1].name = "left"; }, "\"left\" comes twice"},
    {"PatchNameless", [](Mesh& m) { m.patches[1].name.clear(); }, "empty or too long name"},
    {"NoPatches", [](Mesh& m) { m.patches.clear(); }, "the patches end at face 46"}};

INSTANTIATE_TEST_SUITE_P(MeshCheck, DamagedMesh, testing::ValuesIn(damages),
                         [](auto const& damage) { return damage.param.name; });

}  // namespace
}  // namespace gimdem::coupling::message

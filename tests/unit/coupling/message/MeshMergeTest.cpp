// SPDX-License-Identifier: BSD-3-Clause
/// The parts of a mesh, however it is cut, make the whole again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <tuple>

#include "BoxMesh.hpp"
#include "Faults.hpp"
#include "MeshParts.hpp"
#include "message/MeshCheck.hpp"
#include "message/MeshMerge.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;
using message::merge_meshes;

using Point = std::array<double, 3>;
/// Patch (empty: internal), cell that the normal leaves, cell that it enters (-1: none), points in their order with
/// the lowest first.
using Face = std::tuple<std::string, std::int32_t, std::int32_t, std::vector<Point>>;

/// The faces of a mesh whose cell c is called names[c], each seen from the cell with the lower name. Two meshes with
/// the same faces have the same cells, volumes and neighbours.
std::multiset<Face> faces_of(Mesh const& mesh, std::vector<std::int32_t> const& names)
{
    std::multiset<Face> faces;
    auto const add = [&](std::string const& patch, std::size_t f)
    {
        std::vector<Point> points;
        for (auto i = static_cast<std::size_t>(mesh.face_offsets[f]);
             i < static_cast<std::size_t>(mesh.face_offsets[f + 1]); ++i)
        {
            double const* const x = &mesh.points[3 * static_cast<std::size_t>(mesh.face_points[i])];
            points.push_back({x[0], x[1], x[2]});
        }
        std::int32_t from = names[static_cast<std::size_t>(mesh.owner[f])];
        std::int32_t to = f < mesh.neighbour.size() ? names[static_cast<std::size_t>(mesh.neighbour[f])] : -1;
        if (to >= 0 && to < from)
        {
            std::swap(from, to);
            std::reverse(points.begin(), points.end());
        }
        std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
        faces.insert({patch, from, to, points});
    };
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f)
        add("", f);
    for (Patch const& patch : mesh.patches)
        for (std::int32_t i = 0; i < patch.face_count; ++i)
            add(patch.name, static_cast<std::size_t>(patch.start_face + i));
    return faces;
}

std::vector<std::int32_t> own_names(Mesh const& mesh)
{
    std::vector<std::int32_t> names(static_cast<std::size_t>(mesh.cell_count));
    for (std::size_t c = 0; c < names.size(); ++c)
        names[c] = static_cast<std::int32_t>(c);
    return names;
}

Mesh box()
{
    return BoxMesh::make({4, 3, 5}, {0.4, 0.3, 0.5});
}

void expect_whole(Mesh const& whole, std::vector<int> const& rank_of_cell)
{
    MeshParts const pieces = cut(whole, rank_of_cell);
    for (Mesh const& part : pieces.parts)
        ASSERT_EQ(message::find_mesh_fault(view_of(part)).value_or(""), "");

    message::MergedMesh const merged = merge_meshes(pieces.parts);

    EXPECT_EQ(message::find_mesh_fault(view_of(merged.mesh)).value_or(""), "");
    EXPECT_EQ(merged.mesh.cell_count, whole.cell_count);
    EXPECT_EQ(merged.mesh.points.size(), whole.points.size());
    EXPECT_EQ(merged.mesh.owner.size(), whole.owner.size());
    EXPECT_EQ(merged.mesh.neighbour.size(), whole.neighbour.size());
    EXPECT_EQ(merged.mesh.patches.size(), whole.patches.size());
    std::vector<std::int32_t> names;
    for (std::size_t rank = 0; rank < pieces.parts.size(); ++rank)
    {
        EXPECT_EQ(merged.first_cell[rank], static_cast<std::int32_t>(names.size()));
        names.insert(names.end(), pieces.cells[rank].begin(), pieces.cells[rank].end());
    }
    EXPECT_TRUE(faces_of(merged.mesh, names) == faces_of(whole, own_names(whole)));
    for (std::size_t f = 0; f < merged.mesh.neighbour.size(); ++f)
    {
        EXPECT_LT(merged.mesh.owner[f], merged.mesh.neighbour[f]);
        if (f > 0)
        {
            auto const key = [&](std::size_t g) { return std::pair(merged.mesh.owner[g], merged.mesh.neighbour[g]); };
            EXPECT_LT(key(f - 1), key(f));
        }
    }
}

TEST(MeshMerge, MakesTheWholeOfSlices)
{
    Mesh const whole = box();
    for (int const ranks : {2, 3, 4})
        for (int const run : {1, 4, 7, 12, 15})  // checkerboard, lines, ragged, layers, ragged again
        {
            SCOPED_TRACE(std::to_string(ranks) + " ranks, runs of " + std::to_string(run));
            expect_whole(whole, dealt(whole.cell_count, ranks, run));
        }
}

TEST(MeshMerge, MakesTheWholeOfScatteredCells)
{
    Mesh const whole = box();
    std::mt19937 random(3);
    for (int const ranks : {2, 3, 4})
    {
        std::vector<int> rank_of = dealt(whole.cell_count, ranks, 1);
        std::shuffle(rank_of.begin(), rank_of.end(), random);
        SCOPED_TRACE(std::to_string(ranks) + " ranks");
        expect_whole(whole, rank_of);
    }
}

TEST(MeshMerge, LeavesOnePartAsItIs)
{
    Mesh const whole = box();

    Mesh const merged = merge_meshes({whole}).mesh;

    EXPECT_EQ(merged.points, whole.points);
    EXPECT_EQ(merged.face_points, whole.face_points);
    EXPECT_EQ(merged.owner, whole.owner);
    EXPECT_EQ(merged.neighbour, whole.neighbour);
}

/// Coordinates that differ in their last digits, and faces that begin at another point, as other programs may have.
TEST(MeshMerge, SeesTheSameFaceInOtherDigitsAndFromAnotherPoint)
{
    Mesh const whole = box();
    MeshParts pieces = cut(whole, dealt(whole.cell_count, 2, 30));
    Mesh& part = pieces.parts[1];
    for (double& x : part.points)
        x += 1e-9;
    Patch const& patch = part.patches.back();
    auto const first = part.face_points.begin() + part.face_offsets[static_cast<std::size_t>(patch.start_face)];
    std::rotate(first, first + 1, first + 4);

    Mesh const merged = merge_meshes(pieces.parts).mesh;

    EXPECT_EQ(merged.points.size(), whole.points.size());
    EXPECT_EQ(merged.neighbour.size(), whole.neighbour.size());
}

/// Faces of a processor patch may come in any order, as long as it is the same on both sides.
TEST(MeshMerge, SortsInternalFacesWhateverTheOrderOfASeam)
{
    Mesh const whole = box();
    MeshParts pieces = cut(whole, dealt(whole.cell_count, 2, 1));
    for (Mesh& part : pieces.parts)
    {
        Patch const& seam = part.patches.back();
        auto const face = static_cast<std::size_t>(seam.start_face);
        auto const count = static_cast<std::size_t>(seam.face_count);
        std::reverse(part.owner.begin() + seam.start_face, part.owner.begin() + seam.start_face + seam.face_count);
        std::vector<std::int32_t> const points(part.face_points.begin() + part.face_offsets[face],
                                               part.face_points.begin() + part.face_offsets[face + count]);
        for (std::size_t i = 0; i < count; ++i)  // all have four points
            std::copy_n(&points[4 * (count - 1 - i)], 4, part.face_points.begin() + part.face_offsets[face + i]);
    }

    Mesh const merged = merge_meshes(pieces.parts).mesh;

    for (std::size_t f = 1; f < merged.neighbour.size(); ++f)
        EXPECT_LT(std::pair(merged.owner[f - 1], merged.neighbour[f - 1]),
                  std::pair(merged.owner[f], merged.neighbour[f]));
}

class MeshMergeRefuses : public testing::Test
{
protected:
    Patch& seam(std::size_t rank) { return parts[rank].patches.back(); }
    void expect(std::string const& part) { EXPECT_FAULT(merge_meshes(parts), Fault::mesh, part); }

    Mesh whole = box();
    std::vector<Mesh> parts = cut(whole, dealt(whole.cell_count, 2, 36)).parts;
};

TEST_F(MeshMergeRefuses, ARankThatIsNotThere)
{
    seam(0).neighbour_rank = 2;
    expect("\"procBoundary0to1\" of rank 0 leads to rank 2 (there are 2 ranks");
}

TEST_F(MeshMergeRefuses, ARankThatBordersOnItself)
{
    seam(1).neighbour_rank = 1;
    expect("rank 0 has 12 faces, but rank 1 has 0 towards it");
    seam(0).neighbour_rank = 0;
    expect("\"procBoundary0to1\" of rank 0 leads to rank 0 (there are 2 ranks");
}

TEST_F(MeshMergeRefuses, TwoPatchesBetweenTwoRanks)
{
    seam(0).face_count -= 5;
    parts[0].patches.push_back({"again", PatchKind::processor, seam(0).start_face + seam(0).face_count, 5, 1});
    expect("rank 0 has 7 faces, but rank 1 has 12");
    parts[1].patches.back().face_count -= 5;
    parts[1].patches.push_back({"again", PatchKind::processor, seam(1).start_face + seam(1).face_count, 5, 0});
    expect("patch \"again\" of rank 0 leads to rank 1 like another one before it");
}

TEST_F(MeshMergeRefuses, FacesInAnotherOrder)
{
    auto const at = parts[1].face_points.begin() + parts[1].face_offsets[static_cast<std::size_t>(seam(1).start_face)];
    std::rotate(at, at + 4, at + 4 * seam(1).face_count);
    expect("face 0 of patch \"procBoundary0to1\" of rank 0 is not face 0 of patch \"procBoundary1to0\" of rank 1");
}

TEST_F(MeshMergeRefuses, FacesThatLieElsewhere)
{
    for (double& x : parts[1].points)
        x += 1e-5;
    expect("is not face 0 of patch");
}

TEST_F(MeshMergeRefuses, FacesThatAreNotTurnedRound)
{
    auto const at = parts[1].face_points.begin() + parts[1].face_offsets[static_cast<std::size_t>(seam(1).start_face)];
    std::reverse(at, at + 4);
    expect("is not face 0 of patch");
}

TEST_F(MeshMergeRefuses, APatchOfTwoKinds)
{
    parts[1].patches.front().kind = PatchKind::open;
    expect("patch \"left\" of rank 1 is of another kind");
}

}  // namespace
}  // namespace gimdem::test

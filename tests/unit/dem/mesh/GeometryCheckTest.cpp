// SPDX-License-Identifier: BSD-3-Clause
/// Meshes that are refused, and by what name, (G.2a).
#include "mesh/GeometryCheck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "BoxMesh.hpp"
#include "CellMeshes.hpp"
#include "core/Error.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

/// What is said of a mesh; empty if it is taken.
std::string refusal(coupling::Mesh mesh)
{
    try
    {
        PolyMesh const taken(std::move(mesh));
        return "";
    }
    catch (UserError const& error)
    {
        return error.what();
    }
}

void expect_words(std::string const& text, std::initializer_list<char const*> words)
{
    for (char const* word : words)
        EXPECT_NE(text.find(word), std::string::npos) << "no \"" << word << "\" in: " << text;
}

/// 3 x 3 x 3 unit cells; point (i, j, k) has the number i + 4 (j + 4 k).
CellList cubes()
{
    return hexahedra(3, {1, 1, 1});
}
std::size_t point(int i, int j, int k)
{
    return static_cast<std::size_t>(i + 4 * (j + 4 * k));
}

TEST(GeometryCheck, GoodMeshesOfAllKindsAreTaken)
{
    EXPECT_EQ(refusal(BoxMesh::make({3, 3, 3}, {1, 1, 1})), "");
    EXPECT_EQ(refusal(BoxMesh::make({2, 2, 2}, {1, 1, 1e-5})), "");  // cells of a thin layer
    EXPECT_EQ(refusal(tetrahedra(3, {1, 2, 1}).mesh()), "");
    EXPECT_EQ(refusal(shaken(cubes(), 0.2).mesh()), "");
    EXPECT_EQ(refusal(voronoi_cells(3, {1, 1, 1}).mesh()), "");
}

TEST(GeometryCheck, OpenCellIsNamed)
{
    coupling::Mesh mesh = cubes().mesh();
    // The last face's corners go the other way round: its cell is open there.
    std::reverse(mesh.face_points.end() - 4, mesh.face_points.end());
    std::string const cell = "cell " + std::to_string(mesh.owner.back()) + " ";
    expect_words(refusal(mesh), {cell.c_str(), "is open", "turned round", "checkMesh"});
}

TEST(GeometryCheck, CollapsedCellIsNamed)
{
    // The upper four points of the middle cell on its lower ones, but for a rounding.
    CellList list = cubes();
    for (int const j : {1, 2})
        for (int const i : {1, 2})
            list.points[point(i, j, 2)] = list.points[point(i, j, 1)] + Vec3(0, 0, 1e-13);
    expect_words(refusal(list.mesh()), {"cell 13 ", "no volume to speak of", "collapsed"});
}

TEST(GeometryCheck, InvertedCellAmongGoodOnesIsNamed)
{
    CellList list = cubes();
    for (int const j : {1, 2})
        for (int const i : {1, 2})
            list.points[point(i, j, 2)].z() = 0.9;
    expect_words(refusal(list.mesh()), {"cell 13 ", "must be positive"});
}

TEST(GeometryCheck, FaceThatComesTwiceIsNamedWithItsCells)
{
    // Cell 26 has a face that cells 0 and 1 share, once each way round, so that it stays closed.
    coupling::Mesh mesh = cubes().mesh();
    mesh.face_points.insert(mesh.face_points.end(), {1, 5, 21, 17, 17, 21, 5, 1});
    for (int k = 0; k < 2; ++k)
    {
        mesh.face_offsets.push_back(mesh.face_offsets.back() + 4);
        mesh.owner.push_back(26);
        ++mesh.patches.back().face_count;
    }
    expect_words(refusal(mesh), {"have the same points", "of cells 0 and 26", "one owner", "baffle"});
}

TEST(GeometryCheck, BaffleIsTaken)
{
    // All internal faces between two layers become pairs of boundary faces.
    coupling::Mesh const mesh = cubes().mesh();
    coupling::Mesh cut = mesh;
    cut.face_points.clear();
    cut.face_offsets = {0};
    cut.owner.clear();
    cut.neighbour.clear();
    auto const add = [&](std::size_t f, std::int32_t owner, bool reversed)
    {
        std::vector<std::int32_t> points(mesh.face_points.begin() + mesh.face_offsets[f],
                                         mesh.face_points.begin() + mesh.face_offsets[f + 1]);
        if (reversed) std::ranges::reverse(points);
        cut.face_points.insert(cut.face_points.end(), points.begin(), points.end());
        cut.face_offsets.push_back(static_cast<std::int32_t>(cut.face_points.size()));
        cut.owner.push_back(owner);
    };
    auto const is_cut = [&](std::size_t f) { return mesh.owner[f] / 9 == 0 && mesh.neighbour[f] / 9 == 1; };
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f)
        if (!is_cut(f))
        {
            add(f, mesh.owner[f], false);
            cut.neighbour.push_back(mesh.neighbour[f]);
        }
    for (std::size_t f = mesh.neighbour.size(); f < mesh.owner.size(); ++f)
        add(f, mesh.owner[f], false);
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f)
        if (is_cut(f))
        {
            add(f, mesh.owner[f], false);
            add(f, mesh.neighbour[f], true);
        }
    auto const internal = static_cast<std::int32_t>(cut.neighbour.size());
    cut.patches = {
        {"sides", coupling::PatchKind::wall, internal, static_cast<std::int32_t>(cut.owner.size()) - internal}};
    ASSERT_EQ(cut.owner.size(), mesh.owner.size() + 9);
    EXPECT_EQ(refusal(cut), "");
}

TEST(GeometryCheck, FaceTooFarFromPlanarIsNamedWithItsWarp)
{
    // Two opposite corners of one face go out, two in: off the plane by `off` of its edge.
    auto const bent = [](double off)
    {
        CellList list = cubes();
        for (int const j : {1, 2})
            for (int const i : {1, 2})
                list.points[point(i, j, 1)].z() += (i + j) % 2 == 0 ? off : -off;
        return refusal(list.mesh());
    };
    EXPECT_EQ(bent(0.48), "");
    expect_words(bent(0.52), {"face ", "of cell ", "not planar", "off its plane by 0.52 ", "at most 0.5"});
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "PolyMeshFiles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "core/Error.hpp"
#include "mesh/PolyMesh.hpp"

namespace
{

using namespace gimdem;
using testing::ElementsAre;
using testing::HasSubstr;

std::string with_header(std::string const& name, std::string const& text)
{
    return "/*--- banner { ( 3 ---*/\nFoamFile\n{\n    version 2.0;\n    format ascii;\n    object " + name +
           ";\n}\n// * * //\n" + text;
}

/// Two cubes of edge 1 side by side along x, as OpenFOAM writes them.
std::map<std::string, std::string> two_cubes()
{
    return {{"points",
             "12 ((0 0 0)(1 0 0)(2 0 0)(0 1 0)(1 1 0)(2 1 0)\n"
             "(0 0 1)(1 0 1)(2 0 1e0)(0 1 1)(1 1 1) // the last:\n(2 1 1))"},
            {"faces",
             "11\n(\n4(1 4 10 7)\n4(0 6 9 3)\n4(2 5 11 8)\n4(0 1 7 6)\n4(1 2 8 7)\n4(3 9 10 4)\n4(4 10 11 5)\n"
             "4(0 3 4 1)\n4(1 4 5 2)\n4(6 7 10 9)\n4(7 8 11 10)\n)\n"},
            {"owner", "11\n(\n0 0 1 0 1 0 1 0 1 0 1\n)\n"},
            {"neighbour", "1{1}"},
            {"boundary",
             "3\n(\n    inlet\n    {\n        type patch;\n        nFaces 1;\n        startFace 1;\n    }\n"
             "    outlet { type patch; nFaces 1; startFace 2; }\n"
             "    sides { type wall; inGroups 1(wall); nFaces 8; startFace 3; }\n)\n"}};
}

/// A folder of its own, gone with the test.
class PolyMeshFiles : public testing::Test
{
protected:
    void write(std::map<std::string, std::string> const& files)
    {
        create_directories(folder_ / "constant/polyMesh");
        for (auto const& [name, text] : files)
            std::ofstream(folder_ / "constant/polyMesh" / name) << with_header(name, text);
    }

    /// What reading says after `name` became `text`.
    std::string refusal(std::string const& name, std::string const& text)
    {
        auto files = two_cubes();
        files[name] = text;
        write(files);
        try
        {
            test::read_poly_mesh(folder_);
        }
        catch (UserError const& error)
        {
            return error.what();
        }
        return "";
    }

    ~PolyMeshFiles() override { remove_all(folder_); }

    std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("poly-mesh-") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(PolyMeshFiles, AreReadAsTheyAreWritten)
{
    write(two_cubes());

    coupling::Mesh const mesh = test::read_poly_mesh(folder_);

    EXPECT_EQ(mesh.cell_count, 2);
    EXPECT_THAT(mesh.neighbour, ElementsAre(1));
    ASSERT_EQ(mesh.patches.size(), 3u);
    EXPECT_EQ(mesh.patches[0].kind, coupling::PatchKind::open);
    EXPECT_EQ(mesh.patches[2].name, "sides");
    EXPECT_EQ(mesh.patches[2].kind, coupling::PatchKind::wall);
    EXPECT_EQ(mesh.patches[2].face_count, 8);
    PolyMesh const cells(mesh);
    EXPECT_NEAR(cells.volume(0), 1, 1e-15);
    EXPECT_NEAR((cells.centroid(1) - Vec3(1.5, 0.5, 0.5)).norm(), 0, 1e-15);
}

TEST_F(PolyMeshFiles, AreFoundInTheirOwnFolderToo)
{
    write(two_cubes());
    EXPECT_EQ(test::read_poly_mesh(folder_ / "constant/polyMesh").cell_count, 2);
}

TEST_F(PolyMeshFiles, ThatAreWrongAreRefusedWithFileAndLine)
{
    EXPECT_THAT(refusal("points", "12 ((0 0 0)(1 zero 0)"),
                HasSubstr("points:9: \"zero\" where a number was expected"));
    EXPECT_THAT(refusal("points", "1 (\n(0 0 0)\n(1 0 0)\n)"), HasSubstr("points:11: \"(\" where \")\" was expected"));
    EXPECT_THAT(refusal("faces", "1 (3(0 1 99))"), HasSubstr("face 0 has a point 99 that is not there"));
    EXPECT_THAT(refusal("owner", "2(0 1)"), HasSubstr("2 owners for 11 faces"));
    EXPECT_THAT(refusal("owner", "11(0 0 1"), HasSubstr("the file ends too early"));
    EXPECT_THAT(refusal("neighbour", "1{-1}"), HasSubstr("a face has the cell -1"));
    EXPECT_THAT(refusal("neighbour", "12{1}"), HasSubstr("more neighbours than faces"));
    EXPECT_THAT(refusal("boundary", "1(sides { type wall; nFaces 8; startFace 3; })"),
                HasSubstr("patch sides starts at face 3 and not at 1"));
    EXPECT_THAT(refusal("boundary", "1(sides { type wall; nFaces 8; startFace 1; })"),
                HasSubstr("the patches end at face 9 of 11"));
}

TEST_F(PolyMeshFiles, ThatAreBinaryOrAbsentAreRefused)
{
    write(two_cubes());
    std::ofstream(folder_ / "constant/polyMesh/faces") << "FoamFile { format binary; }\n\x01\x02";
    EXPECT_THROW(
        {
            try
            {
                test::read_poly_mesh(folder_);
            }
            catch (UserError const& error)
            {
                EXPECT_THAT(error.what(), HasSubstr("foamFormatConvert"));
                throw;
            }
        },
        UserError);
    EXPECT_THROW(test::read_poly_mesh(folder_ / "nowhere"), UserError);
}

}  // namespace

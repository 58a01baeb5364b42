// SPDX-License-Identifier: BSD-3-Clause
/// STL files that are no wall, and what is said about them.
#include "walls/StlFile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>

#include "StlText.hpp"
#include "core/Error.hpp"
#include "walls/SurfaceCheck.hpp"
#include "walls/WallGeometry.hpp"

namespace
{

using gimdem::Vec3;
using namespace gimdem::test;
using testing::AllOf;
using testing::HasSubstr;

std::string message_of(gimdem::WallItemSettings const& wall)
{
    try
    {
        gimdem::WallGeometry const walls({wall}, 0.01);
    }
    catch (gimdem::UserError const& error)
    {
        return error.what();
    }
    return "no error";
}

std::string message_of(std::string const& content, bool open = false)
{
    TemporaryStl const file(content);
    std::string const message = message_of(stl_wall(file, open));
    EXPECT_TRUE(message == "no error" || message.find(file.path.string()) != std::string::npos) << message;
    return message;
}

Soup const box = box_soup({0, 0, 0}, {1, 2, 3});

TEST(StlFile, GoodOnesAreTaken)
{
    EXPECT_EQ(message_of(ascii_stl(box)), "no error");
    EXPECT_EQ(message_of(binary_stl(box)), "no error");
    TemporaryStl const file(box);
    auto const surface = gimdem::read_stl(file.path, 2);
    EXPECT_EQ(surface.points.size(), 8u);
    EXPECT_EQ(surface.triangles.size(), 12u);
    EXPECT_NEAR(gimdem::signed_volume(surface), 48, 1e-12);
}

TEST(StlFile, MissingEmptyOrNoStlIsRefused)
{
    gimdem::WallItemSettings missing;
    missing.shape = "stl";
    missing.file = "/nowhere/drum.stl";
    EXPECT_THAT(message_of(missing), AllOf(HasSubstr("/nowhere/drum.stl does not exist"), HasSubstr("[[wall]]")));
    EXPECT_THAT(message_of(""), HasSubstr("is empty"));
    EXPECT_THAT(message_of("v 0 0 0\nv 1 0 0\n"), HasSubstr("is no whole STL file"));
    EXPECT_THAT(message_of("solid wall\nendsolid wall\n"),
                testing::AnyOf(HasSubstr("no triangle"), HasSubstr("no whole STL")));
    EXPECT_THAT(message_of("solid wall\nfacet normal 0 0 1\nouter loop\nvertex a b c\n"),
                HasSubstr("is no whole STL file"));
}

TEST(StlFile, CutShortIsRefused)
{
    for (std::string const& whole : {binary_stl(box), ascii_stl(box)})
        for (double const part : {0.02, 0.3, 0.5, 0.9})
            EXPECT_NE(message_of(whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size())))),
                      "no error")
                << part;
}

TEST(StlFile, HoleIsNamedUnlessTheSurfaceIsASheet)
{
    Soup open = box;
    open.erase(open.begin() + 4);
    EXPECT_THAT(message_of(ascii_stl(open)), AllOf(HasSubstr("the surface is open"), HasSubstr("triangle "),
                                                   HasSubstr("alone"), HasSubstr("open = true")));
    EXPECT_EQ(message_of(ascii_stl(open), true), "no error");
}

TEST(StlFile, TriangleWithoutAreaIsNamed)
{
    Soup flat = box;
    flat[6] = {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(0.5, 0.5, 0.5)};
    EXPECT_THAT(message_of(ascii_stl(flat)),
                AllOf(HasSubstr("triangle 7 at (0, 0, 0) m has no area"), HasSubstr("remove")));
    EXPECT_THAT(message_of(ascii_stl(flat), true), HasSubstr("triangle 7"));
    flat[6] = {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(1, 1, 1)};
    EXPECT_THAT(message_of(binary_stl(flat)), HasSubstr("triangle 7"));
}

TEST(StlFile, InsideOutIsTold)
{
    Soup inside_out = box;
    for (Corners& triangle : inside_out)
        std::swap(triangle[0], triangle[1]);
    EXPECT_THAT(message_of(ascii_stl(inside_out)),
                AllOf(HasSubstr("inside out"), HasSubstr("-6 m^3"), HasSubstr("flip")));
    Soup one = box;
    std::swap(one[3][0], one[3][1]);
    EXPECT_THAT(message_of(ascii_stl(one)), AllOf(HasSubstr("wound against each other"), HasSubstr("4")));
}

TEST(StlFile, ThreeTrianglesAtAnEdgeAreNoClosedSurface)
{
    Soup fin = box;
    fin.push_back({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 1)});
    EXPECT_THAT(message_of(ascii_stl(fin)), testing::AnyOf(HasSubstr("belongs to 3 triangles"), HasSubstr("alone")));
}

TEST(StlFile, CoordinateThatIsNoNumberIsRefused)
{
    Soup broken = box;
    broken[9][1].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(message_of(binary_stl(broken)), HasSubstr("triangle 10 has a corner that is not finite"));
    EXPECT_THAT(message_of(ascii_stl(broken)), HasSubstr("triangle 10 has a corner that is not finite"));
    broken[9][1].y() = std::numeric_limits<double>::infinity();
    EXPECT_THAT(message_of(binary_stl(broken), true), HasSubstr("triangle 10"));
}

}  // namespace

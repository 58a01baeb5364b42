// SPDX-License-Identifier: BSD-3-Clause
/// [[wall]] of a case file: what is read, and what is said about mistakes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "CaseText.hpp"
#include "core/Case.hpp"
#include "core/Error.hpp"

namespace
{

using namespace gimdem;
using testing::HasSubstr;

Case parse(std::string const& wall)
{
    return parse_case(test::good_case + "[[wall]]\nname = \"w\"\n" + wall, "case.toml");
}

std::string message_of(std::string const& wall)
{
    try
    {
        parse(wall);
    }
    catch (UserError const& error)
    {
        return error.what();
    }
    return "no error";
}

TEST(WallOfACase, IsReadWithItsMotion)
{
    Case const read = parse(
        "shape = \"cylinder\"\npoint = [1, 2, 3]\naxis = [0, 2, 0]\nradius = 0.1\ninside = true\nvelocity = [0, 1, 0]\n"
        "rotation = { axis = [0, 1, 0], speed = 3 }\n"
        "[wall.vibration]\ndirection = [0, 0, 1]\namplitude = 1e-3\nfrequency = 50\n");
    ASSERT_EQ(read.wall.size(), 1u);
    WallItemSettings const& wall = read.wall[0];
    EXPECT_EQ(wall.shape, "cylinder");
    EXPECT_EQ(wall.point, (Triple{1, 2, 3}));
    EXPECT_TRUE(wall.inside);
    EXPECT_EQ(wall.length, 0);
    EXPECT_EQ(wall.rotation->speed, 3);
    EXPECT_EQ(wall.vibration->frequency, 50);
}

TEST(WallOfACase, MistakesAreNamed)
{
    EXPECT_EQ(message_of("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"), "no error");
    EXPECT_THAT(message_of("shape = \"plane\"\npoint = [0, 0, 0]\n"),
                HasSubstr("\"normal\" of [[wall]] \"w\" is missing"));
    EXPECT_THAT(message_of("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 0]\n"), HasSubstr("is zero"));
    EXPECT_THAT(message_of("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\n"),
                HasSubstr("\"radius\" of [[wall]] \"w\" has no effect"));
    EXPECT_THAT(message_of("shape = \"stl\"\nfile = \"a.stl\"\n"),
                HasSubstr("\"inside\" of [[wall]] \"w\" is missing"));
    EXPECT_THAT(message_of("shape = \"stl\"\nfile = \"a.stl\"\nopen = true\ninside = true\n"), HasSubstr("no effect"));
    EXPECT_THAT(message_of("shape = \"cylinder\"\npoint = [0, 0, 0]\naxis = [0, 1, 0]\nradius = 1\n"),
                HasSubstr("\"inside\""));
    EXPECT_THAT(message_of("shape = \"cone\"\n"), HasSubstr("plane | cylinder | stl"));
    EXPECT_THAT(message_of("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nmaterial = \"glass\"\n"),
                HasSubstr("material \"glass\" is not defined"));
    EXPECT_THAT(message_of("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
                           "rotation = { axis = [0, 0, 0], speed = 1 }\n"),
                HasSubstr("\"rotation.axis\" of [[wall]] \"w\" is zero"));
    EXPECT_THAT(message_of("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n[[wall]]\nname = \"w\"\n"
                           "shape = \"plane\"\npoint = [0, 0, 1]\nnormal = [0, 0, -1]\n"),
                HasSubstr("wall \"w\" is defined twice"));
    std::string const periodic = "[domain]\nperiodic = [true, false, false]\nbox = [[0, 0, 0], [1, 0, 0]]\n";
    EXPECT_THAT(message_of("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0.1, 0, 1]\n" + periodic),
                HasSubstr("\"normal\" of [[wall]] \"w\" has a part along x"));
    EXPECT_EQ(message_of("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n" + periodic), "no error");
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
/// Particles that start in a wall or behind it are named.
#include "engine/WallStartCheck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "StlText.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "walls/SurfaceSide.hpp"

namespace
{

using gimdem::Vec3;
using namespace gimdem::test;
using testing::AllOf;
using testing::HasSubstr;

constexpr double radius = 0.1;

std::string message_of(gimdem::WallItemSettings const& wall, Vec3 const& at)
{
    gimdem::WallGeometry const walls({wall}, 1.2 * radius);
    try
    {
        check_particles_against_walls(particles_of({{at, radius}}), walls);
    }
    catch (gimdem::UserError const& error)
    {
        return error.what();
    }
    return "fine";
}

TEST(Start, InOrBehindAPlaneIsNamed)
{
    auto const plane = plane_wall({0, 0, 1});
    EXPECT_EQ(message_of(plane, {3, 4, 1.0905}), "fine");  // 4.75 % of the diameter
    EXPECT_THAT(message_of(plane, {3, 4, 1.089}),
                AllOf(HasSubstr("particle 0 at (3, 4, 1.089) m"), HasSubstr("0.011 m deep in wall \"plane\"")));
    EXPECT_THAT(message_of(plane, {3, 4, -7}), AllOf(HasSubstr("particle 0"), HasSubstr("behind wall \"plane\"")));
    auto moved = plane;
    moved.vibration = {{0, 0, 1}, 0.05, 1, 1.5};  // starts 0.05 sin(1.5) higher
    EXPECT_THAT(message_of(moved, {3, 4, 1.1}), HasSubstr("0.0499 m deep"));
}

TEST(Start, TubeHoldsThemOnItsSide)
{
    EXPECT_EQ(message_of(tube_wall(1, true), {0.5, 3, 0.5}), "fine");
    EXPECT_THAT(message_of(tube_wall(1, true), {0.95, 3, 0}), HasSubstr("0.05 m deep in wall \"tube\""));
    EXPECT_THAT(message_of(tube_wall(1, true), {2, 3, 0}), HasSubstr("behind wall"));
    EXPECT_EQ(message_of(tube_wall(1, false), {2, 3, 0}), "fine");
    EXPECT_THAT(message_of(tube_wall(1, false), {0.5, 3, 0.5}), HasSubstr("behind wall"));
    // Beyond its ends a tube is nowhere.
    EXPECT_EQ(message_of(tube_wall(1, true, 2), {2, 3, 0}), "fine");
}

TEST(Start, ClosedSurfaceHoldsThemOnItsSide)
{
    TemporaryStl const box(box_soup({0, 0, 0}, {1, 2, 3}));
    EXPECT_EQ(message_of(stl_wall(box, false, true), {0.5, 1, 1}), "fine");
    EXPECT_THAT(message_of(stl_wall(box, false, true), {0.5, 1, -1}), HasSubstr("behind wall \"stl\""));
    EXPECT_THAT(message_of(stl_wall(box, false, true), {0.5, 1, 0.06}), HasSubstr("0.04 m deep in wall \"stl\""));
    EXPECT_EQ(message_of(stl_wall(box, false, false), {0.5, 1, -1}), "fine");
    EXPECT_THAT(message_of(stl_wall(box, false, false), {0.5, 1, 1}), HasSubstr("behind wall \"stl\""));
}

TEST(Start, SheetHasBothSides)
{
    TemporaryStl const sheet(floor_soup(-1, 1, 4));
    EXPECT_EQ(message_of(stl_wall(sheet, true), {0.3, 0.3, 0.1}), "fine");
    EXPECT_EQ(message_of(stl_wall(sheet, true), {0.3, 0.3, -0.1}), "fine");
    EXPECT_THAT(message_of(stl_wall(sheet, true), {0.3, 0.3, -0.03}), HasSubstr("0.07 m deep"));
}

TEST(SurfaceSide, IsThatOfAClosedFormAlsoOnSeams)
{
    // A cube whose corners, edges and diagonals many of the points are exactly above or below.
    TemporaryStl const file(box_soup({0, 0, 0}, {1, 1, 1}));
    gimdem::WallGeometry const walls({stl_wall(file, false)}, 0.1);
    gimdem::SurfaceSide const side(walls.triangles_of(0));
    for (int k = 0; k < 9 * 9 * 9; ++k)
    {
        Vec3 const x = 0.25 * Vec3(k % 9, k / 9 % 9, k / 81) - Vec3(0.5, 0.5, 0.375);
        bool const on_a_face = (x.array() == 0).any() || (x.array() == 1).any();
        bool const inside = (x.array() > 0).all() && (x.array() < 1).all();
        // Below and above the cube a ray hits both faces or none, even along its sides.
        if (on_a_face && x.z() >= 0 && x.z() <= 1) continue;
        EXPECT_EQ(side.winding(x), inside ? 1 : 0) << x.transpose();
    }
}

}  // namespace

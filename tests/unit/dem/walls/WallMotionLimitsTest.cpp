// SPDX-License-Identifier: BSD-3-Clause
/// Walls that jump over particles, and walls at periodic borders, are refused before the first step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "BoxMesh.hpp"
#include "StlText.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "engine/WallBorderCheck.hpp"
#include "engine/WallStepCheck.hpp"

namespace
{

using gimdem::Vec3;
using gimdem::WallItemSettings;
using namespace gimdem::test;
using testing::AllOf;
using testing::HasSubstr;

constexpr double radius = 0.01;
constexpr double dt = 1e-3;
/// Way in a step that is just allowed [m], and the speed that makes it [m/s].
constexpr double way = gimdem::wall_step_limit * radius, fastest = way / dt;

std::string complaint(auto const& check)
{
    try
    {
        check();
    }
    catch (gimdem::UserError const& error)
    {
        return error.what();
    }
    return "fine";
}

/// In a box of 1 x 2 x 3 m.
std::string step_complaint(WallItemSettings const& wall)
{
    gimdem::Case settings = bead_case();
    settings.dem.time_step = dt;
    gimdem::PolyMesh const mesh(BoxMesh::make({1, 1, 1}, {1, 2, 3}));
    gimdem::WallGeometry const walls({wall}, 1.2 * radius);
    return complaint([&] { check_wall_steps(settings, walls, mesh, radius); });
}

TEST(WallStep, OfAPlaneIsThatAlongItsNormal)
{
    auto plane = plane_wall();
    EXPECT_EQ(step_complaint(plane), "fine");
    plane.velocity = {100, 0, 0.99 * fastest};
    EXPECT_EQ(step_complaint(plane), "fine");
    plane.velocity = {0, 0, -1.2 * fastest};
    EXPECT_THAT(step_complaint(plane),
                AllOf(HasSubstr("wall \"plane\" moves 0.006 m in a time step of 0.001 s"),
                      HasSubstr("0.6 of the smallest radius, 0.01 m"), HasSubstr("time_step = 0.00079 or less")));
}

TEST(WallStep, OfAVibrationIsNeverMoreThanItsStroke)
{
    auto plane = plane_wall();
    plane.vibration = {{0, 0, 1}, 0.49 * way, 1e6, 0};  // to and fro many times in a step, but never far
    EXPECT_EQ(step_complaint(plane), "fine");
    plane.vibration->amplitude = 0.51 * way;
    EXPECT_THAT(step_complaint(plane), HasSubstr("moves"));
    plane.vibration = {{0, 0, 1}, 1, 0.99 * fastest / (2 * std::numbers::pi), 0};
    EXPECT_EQ(step_complaint(plane), "fine");
    plane.vibration->frequency *= 1.02;
    EXPECT_THAT(step_complaint(plane), HasSubstr("moves"));
}

TEST(WallStep, OfATurningPlaneIsThatOfTheFarthestCorner)
{
    auto plane = plane_wall();
    plane.rotation = {{0, 1, 0}, {0, 0, 0}, 0.99 * fastest};  // 1 m from the axis is the far side of the box
    EXPECT_EQ(step_complaint(plane), "fine");
    plane.rotation->speed *= 1.02;
    EXPECT_THAT(step_complaint(plane), HasSubstr("moves"));
    plane.rotation = {{0, 0, 1}, {0, 0, 0}, 1000 * fastest};  // in itself
    EXPECT_EQ(step_complaint(plane), "fine");
}

TEST(WallStep, OfATubeIsThatAcrossIt)
{
    auto tube = tube_wall(0.1, true);
    tube.rotation = {{0, -1, 0}, {0, 0, 0}, 1000 * fastest};
    EXPECT_EQ(step_complaint(tube), "fine");
    tube.rotation.reset();
    tube.velocity = {0, 1000 * fastest, 0};
    EXPECT_EQ(step_complaint(tube), "fine");
    tube.velocity = {0.8 * fastest, 5 * fastest, 0.8 * fastest};
    EXPECT_THAT(step_complaint(tube), HasSubstr("moves 0.00566 m"));  // sqrt(2) 0.8
    tube.rotation = {{0, 1, 0}, {0, 0, 0}, 1};
    tube.velocity = {1.2 * fastest, 0, 0};
    EXPECT_THAT(step_complaint(tube), HasSubstr("moves 0.006 m"));
}

TEST(WallStep, OfTrianglesIsThatOfTheFastestCornerAlongItsNormal)
{
    TemporaryStl const mantle(mantle_soup(0.1, 1, 12, 1));
    auto drum = stl_wall(mantle, false, true);
    drum.open = true;
    // Flat strips between corners on a circle: their ends move along the normal with sin(15 degrees) of the speed.
    double const speed = fastest / (0.1 * std::sin(std::numbers::pi / 12));
    drum.rotation = {{0, 1, 0}, {0, 0, 0}, 0.99 * speed};
    EXPECT_EQ(step_complaint(drum), "fine");
    drum.rotation->speed = 1.01 * speed;
    EXPECT_THAT(step_complaint(drum), HasSubstr("wall \"stl\" moves"));
}

constexpr double reach = 1.2 * radius;

/// In a box from (0, 0, 0) to (1, 1, 1) m, periodic along x.
std::string border_complaint(WallItemSettings const& wall)
{
    gimdem::DomainSettings domain;
    domain.box = {{{0, 0, 0}, {1, 1, 1}}};
    domain.periodic = {true, false, false};
    gimdem::WallGeometry const walls({wall}, reach);
    return complaint([&] { check_walls_in_periodic_box(domain, walls, reach); });
}

TEST(PeriodicBorder, TrianglesStayAwayFromIt)
{
    TemporaryStl const inside(box_soup({0.02, -1, -1}, {0.98, 2, 2})), near(box_soup({0.02, -1, -1}, {0.99, 2, 2})),
        across(floor_soup(-1, 2, 4));
    EXPECT_EQ(border_complaint(stl_wall(inside, false, true)), "fine");
    EXPECT_THAT(border_complaint(stl_wall(near, false, true)), HasSubstr("comes to 0.01 m from xmax"));
    EXPECT_THAT(border_complaint(stl_wall(across, true)), HasSubstr("reaches beyond xmin"));
}

TEST(PeriodicBorder, MovingTrianglesStayAwayAllTheTime)
{
    TemporaryStl const box(box_soup({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}));
    auto wall = stl_wall(box, false);
    wall.velocity = {0, 1, 1};
    EXPECT_EQ(border_complaint(wall), "fine");
    wall.velocity = {1e-6, 0, 0};
    EXPECT_THAT(border_complaint(wall), HasSubstr("reaches beyond xmin"));
    wall.velocity = {0, 0, 0};
    wall.vibration = {{1, 0, 0}, 0.38, 1, 0};
    EXPECT_EQ(border_complaint(wall), "fine");
    wall.vibration->amplitude = 0.39;
    EXPECT_THAT(border_complaint(wall), HasSubstr("comes to 0.01 m from xmin"));
    wall.vibration.reset();
    // The farthest edge is sqrt(0.3^2 + 0.3^2) = 0.4243 m from the axis.
    wall.rotation = {{0, 1, 0}, {0.45, 0, 0.3}, 1};
    EXPECT_EQ(border_complaint(wall), "fine");
    wall.rotation->origin[0] = 0.3;
    EXPECT_THAT(border_complaint(wall), HasSubstr("reaches beyond xmin"));
    wall.rotation->axis = {1, 0, 0};  // turns along the border
    EXPECT_EQ(border_complaint(wall), "fine");
}

TEST(PeriodicBorder, PlanesAndTubesGoOnAlongIt)
{
    auto plane = plane_wall();
    EXPECT_EQ(border_complaint(plane), "fine");
    plane.rotation = {{1, 0, 0}, {0, 0, 0}, 1};
    EXPECT_EQ(border_complaint(plane), "fine");
    plane.rotation->axis = {0, 1, 0};
    EXPECT_THAT(border_complaint(plane), HasSubstr("wall \"plane\" reaches beyond xmin"));

    auto tube = tube_wall(0.1, false);  // along y
    tube.point = {0.5, 0, 0.5};
    EXPECT_EQ(border_complaint(tube), "fine");
    tube.point = {0.89, 0, 0.5};
    EXPECT_THAT(border_complaint(tube), HasSubstr("comes to 0.01 m from xmax"));
    tube.axis = {1, 0, 0};
    tube.velocity = {1, 0, 0};
    EXPECT_EQ(border_complaint(tube), "fine");
    tube.axis = {1, 1, 0};
    EXPECT_THAT(border_complaint(tube), HasSubstr("reaches beyond"));
    tube.axis = {1, 0, 0};
    tube.velocity = {0, 0, 0};
    tube.length = 0.05;
    EXPECT_EQ(border_complaint(tube), "fine");
    tube.length = 0.2;
    EXPECT_THAT(border_complaint(tube), HasSubstr("reaches beyond xmax"));
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
/// Walls that move as prescribed, and what they do to a sphere.
#include "walls/WallMotion.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "Figure.hpp"
#include "StlText.hpp"
#include "WallScene.hpp"

namespace
{

using gimdem::Vec3;
using namespace gimdem::test;

constexpr double gravity = 9.81;

gimdem::WallItemSettings all_motions()
{
    auto wall = plane_wall();
    wall.velocity = {0.3, -0.2, 0.1};
    wall.rotation = {{1, 2, 2}, {0.5, 0, -1}, 3.0};
    wall.vibration = {{0, 3, 4}, 0.02, 7.0, 0.4};
    return wall;
}

TEST(WallMotion, VelocityIsTheRateOfPlace)
{
    gimdem::WallMotion const motion(all_motions());
    Vec3 const y(0.7, -1.2, 0.4);
    for (double const t : {0.0, 0.13, 2.9})
    {
        double const h = 1e-5;
        Vec3 const rate = (motion.at(t + h).to_space(y) - motion.at(t - h).to_space(y)) / (2 * h);
        // Central difference: h^2 / 6 of the third derivative, 0.02 (2 pi 7)^3 = 1700 and 1.5 * 27: 3e-8.
        EXPECT_LT((motion.at(t).velocity_at(motion.at(t).to_space(y)) - rate).norm(), 1e-7);
        EXPECT_LT((motion.at(t).to_body(motion.at(t).to_space(y)) - y).norm(), 1e-14);
    }
}

TEST(WallMotion, TurnsAboutTheAxisThroughItsOrigin)
{
    auto wall = plane_wall();
    wall.rotation = {{0, 0, 2}, {1, 0, 0}, 0.5 * std::numbers::pi};
    gimdem::WallPose const pose = gimdem::WallMotion(wall).at(1);  // a quarter turn
    EXPECT_LT((pose.to_space({2, 0, 5}) - Vec3(1, 1, 5)).norm(), 1e-15);
    EXPECT_LT((pose.velocity_at({1, 1, 5}) - 0.5 * std::numbers::pi * Vec3(-1, 0, 0)).norm(), 1e-15);
}

/// Sphere on a belt of speed u: slides with mu g, then rolls with v = u / (1 + m c^2 / I), c = r - overlap / 2.
TEST(Belt, DragsASphereThatThenRolls)
{
    double const r = 0.01, u = 0.7, mu = 0.3, young = 1e7;
    auto belt = plane_wall();
    belt.velocity = {u, 0, 0};
    double const overlap = resting_overlap(r, gravity, young), c = r - overlap / 2;
    WallScene scene({belt}, {{{0, 0, r - overlap}, r}}, gravity, 0.3, mu, young);
    double const share = 1 / (1 + c * c / (0.4 * r * r)), sliding = u * share / (mu * gravity);
    auto const rebuilds = scene.system.rebuilds();

    // The first instant, when the tangential spring is short and its dashpot alone acts, is left out.
    scene.run(1e-3, 1e-5);
    Vec3 const v = scene.velocity(), w = scene.spin();
    double const t = 1e-5 * std::floor(0.5 * sliding / 1e-5);
    scene.run(t, 1e-5);
    // The weight swings a little about its mean after the first kick, which changes nothing on average.
    figure("belt_slip_acceleration_ratio", (scene.velocity() - v).x() / (mu * gravity * t));
    EXPECT_NEAR((scene.velocity() - v).x() / (mu * gravity * t), 1, 1e-6);
    EXPECT_NEAR((scene.spin() - w).y() / (-mu * gravity * t * c / (0.4 * r * r)), 1, 1e-6);

    scene.run(3 * sliding, 1e-5);
    // What the tangential spring holds when sticking begins: its oscillation has died away.
    figure("belt_rolling_speed_ratio", scene.velocity().x() / (u * share));
    EXPECT_NEAR(scene.velocity().x() / (u * share), 1, 1e-6);
    EXPECT_NEAR((scene.velocity().x() - c * scene.spin().y()) / u, 1, 1e-6);
    // A plane that moves along itself makes no list stale; the sphere came 0.09 m far, 90 times half a skin.
    EXPECT_LT(scene.system.rebuilds() - rebuilds, 95);
}

TEST(Belt, CarriesWhatCannotTurnAtItsOwnSpeed)
{
    double const r = 0.01, u = 0.2, young = 1e7;
    auto belt = plane_wall();
    belt.velocity = {0, u, 0};
    WallScene scene({belt}, {{{0, 0, r - resting_overlap(r, gravity, young)}, r}}, gravity, 0.3, 0.3, young);
    scene.system.particles().angular_velocity[0].w = 0;
    double const sliding = u / (0.3 * gravity);
    scene.run(1e-3, 1e-5);
    double const start = scene.velocity().y();
    scene.run(0.8 * sliding - 1e-3, 1e-5);
    EXPECT_NEAR((scene.velocity().y() - start) / (0.3 * gravity * (0.8 * sliding - 1e-3)), 1, 2e-3);
    scene.run(0.7 * sliding, 1e-5);
    EXPECT_NEAR(scene.velocity().y() / u, 1, 1e-6);
}

/// A sphere that rolls on a turntable of angular speed W goes in circles with W / (1 + m c^2 / I), 2/7 W for c = r.
TEST(Turntable, LeadsARollingSphereInACircle)
{
    double const r = 0.01, speed = 10, v = 0.1, from_axis = 0.05, young = 1e7;
    auto table = plane_wall();
    table.rotation = {{0, 0, 1}, {0, 0, 0}, speed};
    double const overlap = resting_overlap(r, gravity, young), c = r - overlap / 2;
    Sphere const ball{{from_axis, 0, r - overlap}, r, {0, v, 0}, {(speed * from_axis - v) / c, 0, 0}};
    WallScene scene({table}, {ball}, gravity, 0.3, 0.5, young);
    double const orbit = speed / (1 + c * c / (0.4 * r * r)), circle = v / orbit;

    double const period = 2 * std::numbers::pi / orbit;
    for (int quarter = 1; quarter <= 4; ++quarter)
    {
        scene.run(period / 4, 2e-5);
        double const angle = quarter * std::numbers::pi / 2;
        Vec3 const centre(from_axis - circle, 0, r - overlap);
        Vec3 const expected = centre + circle * Vec3(std::cos(angle), std::sin(angle), 0);
        // The tangential spring, slack at first, and its dashpot take up 3e-5 of the path and 2e-4 of the speed.
        EXPECT_LT((scene.position() - expected).norm(), 1e-4 * circle * angle) << quarter;
        EXPECT_NEAR(scene.velocity().norm() / v, 1, 3e-4);
        if (quarter == 4) figure("turntable_orbit_deviation", (scene.position() - expected).norm() / (circle * angle));
    }
}

/// Sphere on a floor that vibrates with G = A w^2 / g, from its lowest point; whether and when it leaves.
double time_of_flight_start(double strength)
{
    double const r = 0.005, young = 1e9, frequency = 5, w = 2 * std::numbers::pi * frequency;
    double const amplitude = strength * gravity / (w * w);
    auto floor = plane_wall();
    floor.vibration = {{0, 0, 1}, amplitude, frequency, -std::numbers::pi / 2};
    WallScene scene({floor}, {{{0, 0, r - resting_overlap(r, gravity, young) - amplitude}, r}}, gravity, 0.3, 0.3,
                    young);
    for (int step = 1; step <= 100000; ++step)
    {
        scene.system.step(4e-6);
        if (scene.contacts() == 0) return 4e-6 * step;
    }
    return -1;
}

TEST(VibratingFloor, LaunchesWhenItsAccelerationExceedsGravity)
{
    EXPECT_EQ(time_of_flight_start(0.97), -1);  // two periods without a gap
    for (double const strength : {1.2, 2.0})
    {
        // Leaves where the floor falls faster than g, sin(w t - pi / 2) = 1 / G; at the latest when the gap that opens
        // from then on, A w^3 cos(w t - pi / 2) t^3 / 6, has made up for the overlap at rest.
        double const w = 2 * std::numbers::pi * 5, phase = std::asin(1 / strength);
        double const expected = (phase + std::numbers::pi / 2) / w;
        double const delay =
            std::cbrt(6 * resting_overlap(0.005, gravity, 1e9) / (strength * gravity * w * std::cos(phase)));
        EXPECT_LT(delay, 2e-3);
        double const launch = time_of_flight_start(strength);
        figure(fmt::format("vibrating_floor_{}_launch_late", strength), launch - expected, "s");
        EXPECT_NEAR(launch, expected + delay / 2, delay / 2) << strength;
    }
}

/// A wall that comes at speed u at a resting sphere sends it off with (1 + e) u, (D.8). Only the wall moves: a list
/// that did not count its way would miss the sphere.
void expect_hit(gimdem::WallItemSettings wall, double gap, double tolerance = 1e-3)
{
    double const r = 0.01, u = 0.5;
    WallScene scene({wall}, {{{0, 0, r + gap}, r}}, 0, 0.8, 0.3);
    scene.run((gap + 2 * r) / u, 2e-5);
    EXPECT_NEAR(scene.velocity().z() / (1.8 * u), 1, tolerance) << wall.shape;
    EXPECT_LT(scene.velocity().head<2>().norm(), tolerance * u) << wall.shape;
}

TEST(MovingWall, HitsARestingSphere)
{
    auto plane = plane_wall();
    plane.velocity = {0, 0, 0.5};
    expect_hit(plane, 0.1);

    TemporaryStl const file(floor_soup(-0.3, 0.3, 20));
    auto sheet = stl_wall(file, true);
    sheet.velocity = {0, 0, 0.5};
    expect_hit(sheet, 0.1);

    auto tube = tube_wall(0.5, false);
    tube.point = {0, 0, -0.5};
    tube.velocity = {0, 0, 0.5};
    expect_hit(tube, 0.1);
}

TEST(MovingWall, FlapOfARotatingDrumHitsARestingSphere)
{
    // A flap of 0.1 x 0.1 m in the plane z = 0 that starts a quarter turn away and turns about y: tip speed 0.3 m/s.
    Soup flap;
    add_quad(flap, {-0.01, -0.05, -0.1}, {-0.01, 0.05, -0.1}, {-0.01, 0.05, 0}, {-0.01, -0.05, 0});
    TemporaryStl const file(flap);
    auto wall = stl_wall(file, true);
    wall.rotation = {{0, 1, 0}, {0, 0, 0}, -3.0};
    double const r = 0.01, at = 0.08;
    WallScene scene({wall}, {{{at, 0, 0}, r}}, 0, 0.8, 0.0);
    scene.run(1.6, 2e-5);
    // Hit at the lever sqrt(at^2 - (r - 0.01)^2) = at, if the flap's plane passes 0.01 m from the axis on its far side;
    // the sphere leaves along the flap's normal. The contact takes 1e-2 s, a turn by 0.03: 1e-3 of the speed, and a
    // lever that grows by as much.
    EXPECT_NEAR(scene.velocity().norm() / (1.8 * 3.0 * at), 1, 0.02);
    EXPECT_GT(scene.velocity().norm(), 0.4);
}

TEST(RotatingTube, DragsAlongItsSurfaceAndMakesNoListStale)
{
    // In a drum whose bottom moves to +x a sphere that does not yet roll is pushed by mu N.
    double const r = 0.01, drum = 0.2;
    auto tube = tube_wall(drum, true);
    tube.rotation = {{0, 1, 0}, {0, 0, 0}, -4.0};
    double const overlap = resting_overlap(r);
    WallScene scene({tube}, {{{0, 0, -(drum - r + overlap)}, r}}, gravity, 0.3, 0.3);
    auto const rebuilds = scene.system.rebuilds();
    scene.run(1e-3, 1e-5);
    double const before = scene.spin().y(), time = 1e-3;
    scene.run(time, 1e-5);
    double const mass = 1150 * gimdem::sphere_volume(r);
    EXPECT_NEAR(scene.wall_force().x() / (0.3 * mass * gravity), 1, 1e-3);
    EXPECT_NEAR(scene.wall_force().z() / (mass * gravity), 1, 1e-3);
    EXPECT_EQ(scene.system.rebuilds(), rebuilds);
    // The sphere's own angular momentum grows by what the wall's force does at its lever.
    double const lever = r - overlap / 2;
    EXPECT_NEAR((scene.spin().y() - before) / (-0.3 * gravity * lever * time / (0.4 * r * r)), 1, 2e-2);
}

/// In a turning drum a sphere with rolling friction stays up the side, where gravity balances its torque: it turns on
/// the spot, tan(angle) = mu_r r / c with the lever c = r - overlap / 2.
TEST(RotatingDrum, RollingFrictionHoldsASphereUpItsSide)
{
    double const r = 0.01, drum = 0.2, speed = 4, rolling = 0.1, young = 1e7;
    auto tube = tube_wall(drum, true);
    tube.rotation = {{0, 1, 0}, {0, 0, 0}, -speed};
    gimdem::Case settings = WallScene::made({tube}, gravity, 0.3, 0.5, young);
    settings.dem.rolling_friction = "cdt";
    settings.contacts[0].rolling_friction = rolling;
    double const overlap = resting_overlap(r, gravity * std::cos(std::atan(rolling)), young), c = r - overlap / 2;
    double const angle = std::atan(rolling * r / c), distance = drum - r + overlap;
    Vec3 const at = distance * Vec3(std::sin(angle), 0, -std::cos(angle)), spin(0, -speed * drum / c, 0);
    WallScene scene(settings, {{at, r, {0, 0, 0}, spin}});
    double worst = 0;
    for (int k = 0; k < 20; ++k)
    {
        scene.run(0.05, 2e-5);
        worst = std::max(worst, std::abs(std::atan2(scene.position().x(), -scene.position().z()) / angle - 1));
    }
    figure("drum_rolling_friction_angle_deviation", worst);
    // The tangential spring is slack at first: until it holds, the sphere slips by 2e-5, and then swings, undamped.
    EXPECT_LT(worst, 1e-4);
    EXPECT_NEAR(scene.spin().y() / spin.y(), 1, 1e-4);
}

TEST(MovingWalls, ThreadsDoNotChangeABit)
{
    TemporaryStl const box(box_soup({0, 0, 0}, {0.02, 0.02, 0.03}));
    auto shaken = stl_wall(box, false, true);
    shaken.vibration = {{1, 0, 1}, 1e-3, 30, 0};
    shaken.rotation = {{0, 0, 1}, {0.01, 0.01, 0}, 5};
    std::vector<Sphere> spheres;
    for (int k = 0; k < 100; ++k)
        spheres.push_back({3e-3 * Vec3(k % 5 + 1, k / 5 % 5 + 1, k / 25 + 1) + 1e-4 * Vec3(k % 3, k % 7, k % 5), 1e-3});
    using gimdem::exec::Backend;
    WallScene one({shaken}, spheres, gravity, 0.9, 0.3, 1.2e5),
        two({shaken}, spheres, gravity, 0.9, 0.3, 1.2e5, {Backend::openmp, 2});
    one.run(0.012, 2e-5);
    two.run(0.012, 2e-5);
    EXPECT_GT(one.system.rebuilds(), 3);
    EXPECT_EQ(std::memcmp(one.system.particles().position.host().data(), two.system.particles().position.host().data(),
                          one.system.particles().position.host().size_bytes()),
              0);
    // All are still in the box, wherever it has turned to.
    auto const pose = one.walls.motion(0).at(one.system.walls().time());
    for (int k = 0; k < 100; ++k)
    {
        Vec3 const y = pose.to_body(one.position(k));
        EXPECT_TRUE((y.array() > 0.0005).all() && (y.array() < Vec3(0.0195, 0.0195, 0.0295).array()).all()) << k;
    }
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
/// A sphere that lies, slides or rolls on a plane: static overlap, MFIX-DEM's DEM04, inclines, sliding without
/// rotation.
#include <gtest/gtest.h>

#include "Figure.hpp"
#include "WallImpact.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::Case;
using gimdem::MaterialSettings;
using gimdem::Vec3;

MaterialSettings const stiff{"stiff", 1e4, 1e9, 0.3};

/// Overlap of a sphere that lies on a plane [m], (m g / k)^(2/3).
double static_overlap(MaterialSettings const& bead, MaterialSettings const& wall, double radius, double gravity)
{
    double const weight = bead.density * gimdem::sphere_volume(radius) * gravity;
    return std::pow(weight / HertzImpact::on_wall(bead, wall, radius, 1).stiffness, 2.0 / 3.0);
}

/// A sphere of `stiff` on a plane of the same, at rest in its static overlap but for a speed along x.
struct OnPlane
{
    OnPlane(double radius_, double friction, Vec3 const& gravity, double speed = 0, double restitution = 0.5)
        : radius(radius_), scene(make(friction, gravity, restitution), {{2, 2, 2}, {"bottom"}}, {start(gravity, speed)})
    {
    }

    Case make(double friction, Vec3 const& gravity, double restitution) const
    {
        Case settings = impact_case(stiff, stiff, restitution, friction);
        settings.dem.gravity = {gravity.x(), gravity.y(), gravity.z()};
        return settings;
    }
    Sphere start(Vec3 const& gravity, double speed) const
    {
        double const overlap = static_overlap(stiff, stiff, radius, -gravity.z());
        return {{0.1, 1, radius - overlap}, radius, {speed, 0, 0}};
    }

    double radius;
    SphereBox scene;
};

TEST(Rolling, StaticOverlapIsThatOfHertz)
{
    MaterialSettings const soft{"soft", 2500, 1e7, 0.3};
    for (auto const& [wall, want] : {std::pair{rigid(), 5.3557e-6}, {soft, 8.5017e-6}})
    {
        Case settings = impact_case(soft, wall, 0.1, 0.3);
        settings.dem.gravity = {0, 0, -9.81};
        SphereBox scene(settings, {{0.1, 0.1, 0.1}, {"bottom"}}, {{{0.05, 0.05, 0.005}, 0.005}});
        scene.run(4000, 2e-5);
        double const overlap = 0.005 - scene.position(0).z();
        figure(want < 6e-6 ? "static_overlap_rigid_wall" : "static_overlap_same_wall", overlap, "m");
        // Digits of the reference; the motion is damped to 1e-12 of the overlap in 0.08 s.
        EXPECT_NEAR(overlap / want, 1, 1e-5);
    }
}

/// MFIX-DEM's DEM04: a ball of 1 mm slips from v0 = 0.1 m/s until it rolls.
struct SlippingBall
{
    static constexpr double r = 0.0005, v0 = 0.1, g = 9.80665, dt = 2e-7;
    double friction;
    OnPlane ball;
    double time = 0;  ///< of the slip [s]

    SlippingBall(double friction_, double restitution)
        : friction(friction_), ball(r, friction, {0, 0, -g}, v0, restitution)
    {
        while (ball.scene.velocity(0).x() > r * ball.scene.spin(0).y() && time < 1)
        {
            ball.scene.run(1, dt);
            time += dt;
        }
    }
    double scaled_time() const { return friction * g * time / v0; }
    double speed() const { return ball.scene.velocity(0).x() / v0; }
    double spin() const { return r * ball.scene.spin(0).y() / v0; }
};

TEST(Rolling, SlippingBallRollsWhenAndHowFastItMust)
{
    // Slip ends at 2 v0/(7 mu g), then v = R w = 5/7 v0. MFIX's own errors: 0.57 %, 0.017 %, 0.042 %.
    for (double const mu : {0.2, 0.4, 0.6, 0.8, 1.0})
    {
        SlippingBall const ball(mu, 1);
        figure(fmt::format("dem04_{}_time", mu), ball.scaled_time());
        figure(fmt::format("dem04_{}_speed", mu), ball.speed());
        figure(fmt::format("dem04_{}_spin", mu), ball.spin());
        // The end is found to a step, 7e-5 of the time at mu = 1, and the spring must stretch first; overlap/R is 4e-5.
        EXPECT_NEAR(ball.scaled_time(), 2.0 / 7, 2e-4 * 2 / 7);
        EXPECT_NEAR(ball.speed(), 5.0 / 7, 1e-4 * 5 / 7);
        EXPECT_NEAR(ball.spin(), 5.0 / 7, 1e-4 * 5 / 7);
    }
}

TEST(Rolling, SlippingBallWithLossGoesOnRolling)
{
    for (double const mu : {0.2, 1.0})
    {
        SlippingBall ball(mu, 0.5);
        figure(fmt::format("dem04_lossy_{}_time", mu), ball.scaled_time());
        // The dashpot of a contact that has not slid yet is not bounded by friction: it takes part of the first step's
        // speed. MFIX's error is allowed.
        EXPECT_NEAR(ball.scaled_time(), 2.0 / 7, 5.7e-3 * 2 / 7);
        ball.ball.scene.run(20000, SlippingBall::dt);
        // The spring's ringing is damped; overlap/R.
        EXPECT_NEAR(ball.speed(), 5.0 / 7, 1e-4 * 5 / 7);
        EXPECT_NEAR(ball.spin(), 5.0 / 7, 1e-4 * 5 / 7);
    }
}

/// Linear and angular acceleration down an incline, between two instants.
struct Acceleration
{
    double linear, angular;
};

Acceleration down_incline(double angle, double friction)
{
    OnPlane ball(0.005, friction, Vec3(9.81 * std::sin(angle), 0, -9.81 * std::cos(angle)));
    double const dt = 2e-6;
    ball.scene.run(5000, dt);
    double const v = ball.scene.velocity(0).x(), w = ball.scene.spin(0).y();
    int const steps = 20000;
    ball.scene.run(steps, dt);
    return {(ball.scene.velocity(0).x() - v) / (steps * dt), (ball.scene.spin(0).y() - w) / (steps * dt)};
}

TEST(Rolling, GentleInclineMakesItRollWithoutSlip)
{
    // tan(angle) <= 7/2 mu: 5/7 g sin(angle).
    for (auto const& [angle, mu] : {std::pair{0.1, 0.05}, {0.3, 0.2}, {0.7, 0.3}})
    {
        Acceleration const a = down_incline(angle, mu);
        double const want = 5.0 / 7 * 9.81 * std::sin(angle);
        figure(fmt::format("incline_{}_rolling", angle), a.linear / want);
        // It rolls on its height R - overlap, and the lever is R - overlap/2: overlap/R is 2e-4.
        EXPECT_NEAR(a.linear / want, 1, 2e-4);
        EXPECT_NEAR(0.005 * a.angular / want, 1, 2e-4);
    }
}

TEST(Rolling, SteepInclineMakesItSlideAndSpin)
{
    // tan(angle) > 7/2 mu: g (sin - mu cos), R dw/dt = 5/2 mu g cos.
    for (auto const& [angle, mu] : {std::pair{0.3, 0.05}, {0.7, 0.2}, {1.2, 0.3}})
    {
        Acceleration const a = down_incline(angle, mu);
        double const want = 9.81 * (std::sin(angle) - mu * std::cos(angle));
        double const spin = 2.5 * mu * 9.81 * std::cos(angle);
        figure(fmt::format("incline_{}_sliding", angle), a.linear / want);
        figure(fmt::format("incline_{}_spinning", angle), 0.005 * a.angular / spin);
        // Overlap/R is 2e-4, and half of it shortens the lever.
        EXPECT_NEAR(a.linear / want, 1, 1e-5);
        EXPECT_NEAR(0.005 * a.angular / spin, 1, 2e-4);
    }
}

TEST(Rolling, SlideWithoutRotationIsThatOfCoulomb)
{
    // Gravity (8, 0, -10) m/s^2, rotation locked: x = (g_x - mu g_z) t^2 / 2.
    for (double const mu : {0.3, 0.6})
    {
        OnPlane block(0.005, mu, {8, 0, -10});
        block.scene.lock_rotation(0);
        double const dt = 2e-6;
        // While the spring stretches, by less than the overlap of 1e-6 m, friction is smaller: start after that.
        block.scene.run(1000, dt);
        double const x = block.scene.position(0).x(), v = block.scene.velocity(0).x();
        double const t = 50000 * dt, want = (8 - mu * 10) * t * t / 2;
        block.scene.run(50000, dt);
        double const moved = block.scene.position(0).x() - x - v * t;
        figure(fmt::format("locked_slide_{}", mu), moved / want);
        // The normal force is the weight to rounding, and a constant force is integrated exactly.
        EXPECT_NEAR(moved / want, 1, 1e-8);
    }
}

TEST(Rolling, LockedSphereHangsOnItsSpring)
{
    // Friction 1.7 holds even twice the load that comes suddenly. At rest 0.8 W = S_t xi and W = 2/3 S_n overlap, with
    // S_t / S_n = 2 (1 - nu) / (2 - nu).
    OnPlane block(0.005, 1.7, {8, 0, -10});
    block.scene.lock_rotation(0);
    block.scene.run(50000, 2e-6);
    double const want = 0.8 * (2.0 / 3) * (2 - 0.3) / (2 * (1 - 0.3)) * static_overlap(stiff, stiff, 0.005, 10);
    double const moved = block.scene.position(0).x() - 0.1;
    figure("locked_stick_moved", moved / want);
    // Positions near 0.1 m are rounded to 1e-17: 1e-11 of 0.6 um a step; the ringing is damped away in 0.1 s.
    EXPECT_NEAR(moved / want, 1, 1e-6);
    EXPECT_NEAR(block.scene.velocity(0).x(), 0, 1e-9);
}

}  // namespace

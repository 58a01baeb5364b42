// SPDX-License-Identifier: BSD-3-Clause
#include "contact/HertzMindlin.hpp"

#include <gtest/gtest.h>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "engine/DemSystem.hpp"

namespace
{

using gimdem::Case;
using gimdem::DemSystem;
using gimdem::Materials;
using gimdem::Vec3;
using gimdem::test::BoxMesh;
using gimdem::test::particles_of;
using gimdem::test::serial;
using gimdem::test::Sphere;

/// Spheres in a box far larger than they are.
struct Collision
{
    explicit Collision(Case const& settings_, std::vector<Sphere> const& spheres)
        : settings(settings_),
          materials(settings),
          mesh(BoxMesh::make({1, 1, 1}, {1, 1, 1})),
          walls(mesh, {"bottom"}, 0.2),
          system(settings, serial, materials, walls, particles_of(spheres, settings.materials[0].density))
    {
        system.prepare();
        system.begin_coupling_step(nullptr);
    }

    Vec3 velocity(std::int64_t id) const { return find(system.particles().velocity, id); }
    Vec3 spin(std::int64_t id) const { return find(system.particles().angular_velocity, id); }
    Vec3 find(gimdem::exec::Buffer<gimdem::Quad> const& values, std::int64_t id) const
    {
        for (std::int64_t i = 0; i < system.particles().count(); ++i)
            if (system.particles().id[i] == id) return values[i].xyz();
        return Vec3::Constant(NAN);
    }
    void run(int steps, double dt)
    {
        for (int s = 0; s < steps; ++s)
            system.step(dt);
    }

    Case settings;
    Materials materials;
    gimdem::PolyMesh mesh;
    gimdem::WallGeometry walls;
    DemSystem system;
};

Case glass(double restitution, double friction)
{
    Case settings = gimdem::test::bead_case(restitution, friction);
    settings.materials = {{"bead", 2800, 4.8e10, 0.2}};
    return settings;
}

TEST(HertzMindlin, HeadOnElasticImpactHasTheForceDepthAndDurationOfHertz)
{
    // Chung & Ooi (2011) test 1, glass: F_max 10.6969 kN, depth 274.113 um, duration 40.339 us.
    Collision impact(glass(1, 0.35),
                     {{{0.48, 0.5, 0.5}, 0.01, {10, 0, 0}}, {{0.5 + 1e-9, 0.5, 0.5}, 0.01, {-10, 0, 0}}});
    double const dt = 2e-8;
    double deepest = 0, largest = 0, duration = 0;
    for (int s = 0; s < 3000; ++s)
    {
        impact.system.step(dt);
        auto const& p = impact.system.particles();
        double const depth = 0.02 - (p.position[0].xyz() - p.position[1].xyz()).norm();
        deepest = std::max(deepest, depth);
        largest = std::max(largest, p.force[0].xyz().norm());
        duration += depth > 0 ? dt : 0;
    }
    // 2000 steps per contact: the scheme's error is below 1e-5, the duration is counted in steps.
    EXPECT_NEAR(deepest, 274.113e-6, 274.113e-6 * 1e-5);
    EXPECT_NEAR(largest, 10696.9, 10696.9 * 1e-5);
    EXPECT_NEAR(duration, 40.339e-6, 2 * dt);
}

TEST(HertzMindlin, RestitutionIsThatOfTheMaterialAtAnySpeed)
{
    for (double const e : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0})
        for (double const speed : {0.01, 1.0})
        {
            Collision impact(gimdem::test::bead_case(e, 0), {{{0.4, 0.5, 0.5}, 0.001, {speed, 0, 0}},
                                                             {{0.402 + 1e-6 * speed, 0.5, 0.5}, 0.001, {0, 0, 0}}});
            // Hertz contact time ~ v^(-1/5); damped contacts last up to 1.8 times longer.
            double const dt = 1e-6 * std::pow(speed, -0.2);
            impact.run(3000, dt);
            double const rebound = impact.velocity(1).x() - impact.velocity(0).x();
            // About 800 steps per contact, order two: below 1e-4 where the damping is weak, 1e-3 at e = 0.1.
            EXPECT_NEAR(rebound / speed, e, 1e-3) << e << ' ' << speed;
        }
}

TEST(HertzMindlin, WallReboundIsThatOfTheMaterial)
{
    Collision impact(gimdem::test::bead_case(0.8, 0), {{{0.5, 0.5, 0.0010001}, 0.001, {0, 0, -0.5}}});
    impact.run(3000, 1e-6);
    EXPECT_NEAR(impact.velocity(0).z(), 0.4, 0.4 * 1e-3);
}

TEST(HertzMindlin, GrossSlidingFollowsTheImpulseOfCoulomb)
{
    // tan(angle) = 2 >= 7/2 mu (1 + e): v_t' = v_t - mu (1 + e) v_n, R w' = 5/2 mu (1 + e) v_n.
    double const e = 0.9, mu = 0.1, v_n = 0.5, v_t = 1.0, r = 0.001;
    Case settings = gimdem::test::bead_case(e, mu);
    settings.materials = {{"bead", 1150, 1e9, 0.33}};
    Collision impact(settings, {{{0.5, 0.5, r + 1e-9}, r, {v_t, 0, -v_n}}});
    impact.run(4000, 1e-8);
    // |F_n| holds friction in the short attractive end of the contact too: with weak damping below 1e-3.
    EXPECT_NEAR(impact.velocity(0).x(), v_t - mu * (1 + e) * v_n, 1e-3);
    // The lever is r - overlap/2 and not r: overlaps of 1 % at most.
    EXPECT_NEAR(impact.spin(0).y() * r, 2.5 * mu * (1 + e) * v_n, 0.005 * 2.5 * mu * (1 + e) * v_n);
}

TEST(HertzMindlin, ObliqueImpactKeepsMomentumAndAngularMomentum)
{
    Collision impact(gimdem::test::bead_case(0.7, 0.4),
                     {{{0.4, 0.5, 0.5}, 0.001, {0.3, 0.1, -0.05}, {20, -5, 3}},
                      {{0.4028, 0.5003, 0.5002}, 0.002, {-0.2, 0, 0.1}, {-4, 8, 1}}});
    auto const total = [&]
    {
        Vec3 p = Vec3::Zero(), l = Vec3::Zero();
        auto const& s = impact.system.particles();
        for (std::int64_t i = 0; i < 2; ++i)
        {
            p += s.mass(i) * s.velocity[i].xyz();
            l += s.mass(i) * (s.position[i].xyz() - Vec3(0.4, 0.5, 0.5)).cross(s.velocity[i].xyz()) +
                 s.angular_velocity[i].xyz() / s.angular_velocity[i].w;
        }
        return std::pair(p, l);
    };
    auto const before = total();
    double const spin_before = impact.spin(0).norm();
    impact.run(3000, 1e-6);
    auto const after = total();
    // Rounding of 3000 steps: of the velocities, and of positions near 0.5 m against levers of 3 mm (3e-14 a step).
    EXPECT_LT((after.first - before.first).norm(), 1e-12 * before.first.norm());
    EXPECT_LT((after.second - before.second).norm(), 1e-10 * before.second.norm());
    EXPECT_GT(std::abs(impact.spin(0).norm() - spin_before), 0.1);  // they did touch and rub
}

TEST(HertzMindlin, SlippingBallEndsUpRolling)
{
    // Slip ends at 2 v0 / (7 mu g), with v = 5/7 v0.
    Case settings = gimdem::test::bead_case(0.9, 0.3);
    settings.materials = {{"bead", 1e4, 1e7, 0.3}};
    settings.dem.gravity = {0, 0, -9.81};
    double const r = 0.0005, v0 = 0.1, weight = 1e4 * gimdem::sphere_volume(r) * 9.81;
    // Start at the static overlap, or the ball hops.
    double const young_eff = 1e7 / (2 * (1 - 0.09));
    double const overlap = std::pow(weight * 0.75 / (young_eff * std::sqrt(r)), 2.0 / 3.0);
    Collision ball(settings, {{{0.4, 0.5, r - overlap}, r, {v0, 0, 0}}});
    double const dt = 1e-6, slip_time = 2 * v0 / (7 * 0.3 * 9.81);
    ball.run(static_cast<int>(1.5 * slip_time / dt), dt);
    // The tangential spring rings after the slip ends: its amplitude is 1e-3 of v0 and decays.
    EXPECT_NEAR(ball.velocity(0).x() / v0, 5.0 / 7, 2e-3);
    EXPECT_NEAR(ball.spin(0).y() * r / v0, 5.0 / 7, 2e-3);
}

}  // namespace

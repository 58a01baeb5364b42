// SPDX-License-Identifier: BSD-3-Clause
#include "contact/RollingFriction.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "ContactScene.hpp"
#include "contact/LinearSpringDashpot.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

TEST(ConstantTorque, RollingSphereStopsAfterTheDistanceOfTheConstantDeceleration)
{
    RollingBall const ball;
    double const mu_r = 0.2, v0 = 0.15;
    ContactScene scene(ball.settings("cdt", mu_r), {ball.at_speed(v0)});
    double const slowing = 5.0 / 7 * mu_r * ball.gravity, stop_time = v0 / slowing, dt = ball.time_step();

    scene.run(static_cast<int>(0.5 * stop_time / dt), dt);
    // The overlap is 7e-5 of the radius; the friction spring needs a contact time of 1 / 250 of the way to be
    // stretched.
    EXPECT_NEAR(scene.velocity(0).x(), 0.5 * v0, 1e-3 * v0);
    double farthest = 0;
    for (double t = 0; t < 0.6 * stop_time; t += dt)
    {
        scene.system.step(dt);
        farthest = std::max(farthest, scene.position(0).x() - 0.3);
    }
    EXPECT_NEAR(farthest / (7 * v0 * v0 / (10 * mu_r * ball.gravity)), 1, 1e-3);
    // It chatters about rest by the change of one step.
    EXPECT_LT(std::abs(scene.velocity(0).x()), 5 * slowing * dt);
}

/// Distance rolled down a slope within a time that would take a free sphere `free` metres.
double rolled(std::string const& law, double mu_r, double slope, double free)
{
    RollingBall ball;
    ball.slope = slope;
    ContactScene scene(ball.settings(law, mu_r, 0.3), {ball.at_speed(0)});
    double const time = std::sqrt(2 * free / (5.0 / 7 * ball.gravity * std::sin(slope))), dt = ball.time_step();
    scene.run(static_cast<int>(time / dt), dt);
    return scene.position(0).x() - 0.3;
}

TEST(RollingFriction, SphereOnASlopeRestsBelowTheAngleOfRollingFrictionAndRollsAbove)
{
    double const mu_r = 0.1, free = 0.05;
    for (auto const* const law : {"cdt", "epsd"})
    {
        EXPECT_LT(std::abs(rolled(law, mu_r, std::atan(0.95 * mu_r), free)), 2e-4 * free) << law;
        // a = 5/7 g (sin - mu_r cos): of the free distance the share 1 - mu_r / tan.
        EXPECT_NEAR(rolled(law, mu_r, std::atan(1.5 * mu_r), free) / free, 1.0 / 3, 4e-3) << law;
    }
    EXPECT_NEAR(rolled("none", mu_r, std::atan(0.1), free) / free, 1, 1e-3);
}

TEST(ElasticPlasticSpring, TorqueGrowsWithTheAngleUpToTheMobilisation)
{
    double const mu_r = 0.1, stiffness = 1e4, overlap = 1e-6, radius = 2e-3, rate = 2.0, dt = 1e-6;
    ElasticPlasticSpring::Constants<double> const constants{mu_r, 0};
    ContactGeometry<double> const contact{.normal = {0, 0, 1},
                                          .overlap = overlap,
                                          .velocity = {0, 0, 0},
                                          .radius_eff = radius,
                                          .mass_eff = 1e-4,
                                          .spin = {0, rate, 5.0},  // twisting is not rolling
                                          .inverse_inertia = 1e9};
    ContactForce<double> const force{{}, {}, stiffness * overlap, stiffness};
    double const mobilisation = overlap / (2.25 * mu_r * radius), limit = mu_r * radius * stiffness * overlap;
    Vector3<double> spring{0, 0, 0};
    for (int s = 1; s * rate * dt < 1.5 * mobilisation; ++s)
    {
        auto const torque = ElasticPlasticSpring::apply<double>(constants, dt, contact, force, spring);
        double const expected = -limit * std::min(1.0, s * rate * dt / mobilisation);
        EXPECT_NEAR(torque.y, expected, 1e-9 * limit) << s;
        EXPECT_EQ(torque.z, 0);
    }
}

TEST(ElasticPlasticSpring, SmallOscillationHasTheFrequencyOfTheRollingSphere)
{
    RollingBall const ball;
    double const mu_r = 0.01;
    ContactScene scene(ball.settings("epsd", mu_r, 0), {ball.at_speed(1e-4)});
    double const omega = std::sqrt(2.25 * ball.stiffness * mu_r * mu_r / (1.4 * ball.mass())), dt = ball.time_step();
    // Time of the sixth change of the direction: 5 1/2 half periods after the start at full speed.
    int turns = 0;
    double time = 0, before = 1;
    while (turns < 6 && time < 10 * std::numbers::pi / omega)
    {
        scene.system.step(dt);
        time += dt;
        double const now = scene.velocity(0).x();
        turns += now * before < 0;
        before = now;
    }
    // The tangential spring in series takes (omega^2 m) / k_n = 1.6e-4 of the stiffness; one step is 1e-4 of the time.
    EXPECT_NEAR(time * omega / (5.5 * std::numbers::pi), 1, 1e-3);
}

TEST(ElasticPlasticSpring, OscillationDecaysByItsDampingRatio)
{
    RollingBall const ball;
    double const mu_r = 0.01, share = 0.1;
    ContactScene scene(ball.settings("epsd", mu_r, share), {ball.at_speed(1e-4)});
    double const omega = std::sqrt(2.25 * ball.stiffness * mu_r * mu_r / (1.4 * ball.mass())), dt = ball.time_step();
    double const damped = omega * std::sqrt(1 - share * share);
    scene.run(static_cast<int>(std::lround(4 * std::numbers::pi / damped / dt)), dt);
    // Two periods: exp(-0.1 omega t). The phase is known to half a step, the frequency to 1.6e-4.
    double const expected = 1e-4 * std::exp(-share * omega * 4 * std::numbers::pi / damped);
    EXPECT_NEAR(scene.velocity(0).x() / expected, 1, 0.01);
}

TEST(ElasticPlasticSpring, RollingSphereComesToExactRest)
{
    RollingBall const ball;
    double const mu_r = 0.2, v0 = 0.05, stop_time = 7 * v0 / (5 * mu_r * ball.gravity), dt = ball.time_step();
    ContactScene scene(ball.settings("epsd", mu_r, 0.3), {ball.at_speed(v0)});
    scene.run(static_cast<int>(3 * stop_time / dt), dt);
    // Rolling to and fro has a period of 4 ms here and is damped to a tenth in each: nothing but rounding is left.
    EXPECT_LT(scene.velocity(0).norm(), 1e-10 * v0);
    EXPECT_LT(scene.spin(0).norm() * ball.radius, 1e-10 * v0);
    EXPECT_NEAR(scene.position(0).x() - 0.3, 7 * v0 * v0 / (10 * mu_r * ball.gravity), 0.02 * v0 * stop_time);
}

}  // namespace

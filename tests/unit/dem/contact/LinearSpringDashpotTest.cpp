// SPDX-License-Identifier: BSD-3-Clause
#include "contact/LinearSpringDashpot.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "ContactScene.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr double density = 2000, radius = 1e-3, stiffness = 500;
double const mass = density * sphere_volume(radius);

TEST(LinearSpringDashpot, RestitutionAndDurationAreThoseOfTheDampedOscillator)
{
    for (double const e : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0})
    {
        ContactScene impact(linear_case(stiffness, e, density),
                            {{{0.4, 0.5, 0.5}, radius, {0.2, 0, 0}}, {{0.402 + 1e-9, 0.5, 0.5}, radius, {0, 0, 0}}});
        double const beta = -std::log(e) / std::hypot(std::log(e), std::numbers::pi);
        double const expected = LinearSpringDashpot::duration(stiffness, mass / 2) / std::sqrt(1 - beta * beta);
        double const dt = expected / 4000;
        double duration = 0;
        for (int s = 0; s < 5000; ++s)
        {
            impact.system.step(dt);
            duration += (impact.position(1) - impact.position(0)).norm() < 2 * radius ? dt : 0;
        }
        // The dashpot sees the velocity of half a step ago: first order, 2 pi / 4000 at most.
        EXPECT_NEAR((impact.velocity(1) - impact.velocity(0)).x() / 0.2, e, 1.5e-3) << e;
        EXPECT_NEAR(duration, expected, 2e-3 * expected) << e;
    }
}

TEST(LinearSpringDashpot, ElasticDepthIsThatOfTheOscillator)
{
    ContactScene impact(linear_case(stiffness, 1, density),
                        {{{0.4, 0.5, 0.5}, radius, {0.2, 0, 0}}, {{0.402 + 1e-12, 0.5, 0.5}, radius, {0, 0, 0}}});
    double const dt = LinearSpringDashpot::duration(stiffness, mass / 2) / 2000;
    double deepest = 0;
    for (int s = 0; s < 2000; ++s)
    {
        impact.system.step(dt);
        deepest = std::max(deepest, 2 * radius - (impact.position(1) - impact.position(0)).norm());
    }
    // Second order in pi / 2000.
    EXPECT_NEAR(deepest / (0.2 * std::sqrt(mass / 2 / stiffness)), 1, 1e-5);
}

ContactGeometry<double> contact_with(Vector3<double> const& normal, Vector3<double> const& velocity, double overlap)
{
    return {.normal = normal, .overlap = overlap, .velocity = velocity, .radius_eff = radius / 2, .mass_eff = mass / 2};
}

/// k_n = 500 N/m, k_t a quarter of it; a normal force of any sign.
LinearConstants<double> constants_of(double damping, double friction)
{
    return {.stiffness = 500,
            .damping = damping,
            .stiffness_ratio = 0.25,
            .friction = friction,
            .tangential_share = 0.5,
            .least_force = -1e30};
}

TEST(LinearSpringDashpot, ForceIsSpringPlusDashpotInBothDirections)
{
    auto const constants = constants_of(0.2, 10);
    Vector3<double> spring{0, 0, 0};
    auto const contact = contact_with({0, 0, 1}, {0.01, 0, -0.02}, 1e-5);

    auto const out = LinearSpringDashpot::apply<double>(constants, 1e-6, contact, spring);

    double const dashpot = 0.2 * std::sqrt(500 * mass / 2);
    EXPECT_DOUBLE_EQ(out.normal, 500 * 1e-5 + dashpot * 0.02);
    EXPECT_DOUBLE_EQ(out.force.z, out.normal);
    EXPECT_DOUBLE_EQ(spring.x, 1e-8);
    EXPECT_DOUBLE_EQ(out.tangential.x, -(125 * 1e-8 + 0.5 * dashpot * 0.01));
    EXPECT_EQ(out.stiffness, 500);
}

TEST(LinearSpringDashpot, LimitedDampingNeverPulls)
{
    auto constants = constants_of(0.2, 10);
    constants.tangential_share = constants.least_force = 0;
    Vector3<double> spring{0, 0, 0};
    // It parts so fast that the dashpot is stronger than the spring.
    auto const out =
        LinearSpringDashpot::apply<double>(constants, 1e-6, contact_with({0, 0, 1}, {0.01, 0, 10}, 1e-5), spring);
    EXPECT_EQ(out.normal, 0);
    EXPECT_EQ(out.tangential.x, 0);  // what does not press does not rub
}

TEST(LinearSpringDashpot, SlidingForceIsCoulombsAndTheSpringIsCutToIt)
{
    auto const constants = constants_of(0, 0.3);
    Vector3<double> spring{3e-4, 4e-4, 0};

    auto const out =
        LinearSpringDashpot::apply<double>(constants, 1e-6, contact_with({0, 0, 1}, {0, 0, 0}, 1e-5), spring);

    double const limit = 0.3 * 500 * 1e-5;
    EXPECT_NEAR(out.tangential.x, -0.6 * limit, 1e-15 * limit * 10);
    EXPECT_NEAR(out.tangential.y, -0.8 * limit, 1e-15 * limit * 10);
    EXPECT_NEAR(std::hypot(spring.x, spring.y), limit / 125, 1e-14 * limit / 125);
}

TEST(TangentialSpring, TurnsWithTheContactPlaneAndKeepsItsLength)
{
    Vector3<double> spring{2e-6, 1e-6, 0};
    double const length = std::sqrt(spring.dot(spring));
    // The plane turns by 90 degrees about y in 90 steps: what was along x ends up along z.
    for (int s = 1; s <= 90; ++s)
    {
        double const angle = s * std::numbers::pi / 180;
        turn_into_plane(Vector3<double>{std::sin(angle), 0, std::cos(angle)}, spring);
    }
    EXPECT_NEAR(spring.x, 0, 1e-12 * length);  // in the plane: rounding
    EXPECT_NEAR(spring.dot(spring), length * length, 1e-12 * length * length);
    EXPECT_LT(spring.z, -0.8 * length);
}

}  // namespace

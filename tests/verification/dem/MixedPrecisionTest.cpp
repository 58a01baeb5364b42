// SPDX-License-Identifier: BSD-3-Clause
/// precision = "mixed" beside double: impacts of two beads.
#include <gtest/gtest.h>

#include "Figure.hpp"
#include "HertzImpact.hpp"
#include "OpenSpaceSystem.hpp"
#include "core/Error.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::Case;
using gimdem::Vec3;

double constexpr r = 7.725e-4, speed = 0.1;  // [m], [m/s]

/// Two beads after they met, off centre by `offset` radii, 500 steps to a contact.
struct AfterImpact
{
    Vec3 velocity, spin;

    AfterImpact(std::string const& precision, double restitution, double friction, double offset)
    {
        Case settings = bead_case(restitution, friction);
        settings.dem.precision = precision;
        // Far from the origin, as in a large scene: there positions have fewer digits.
        Vec3 const at(0.37, 0.21, 0.53);
        OpenSpaceSystem scene(settings, {{at - Vec3(1.001 * r, 0, 0), r, {speed, 0, 0}, {3, -20, 10}},
                                         {at + Vec3(1.001 * r, offset * r, 0), r, {-speed, 0, 0}, {0, 5, 0}}});
        double const dt = HertzImpact::of_twins(settings.materials[0], r, 2 * speed).duration / 500;
        scene.run(800, dt);
        auto const& p = scene.system.particles();
        std::int64_t const i = p.id[0] == 0 ? 0 : 1;
        velocity = p.velocity[i].xyz();
        spin = p.angular_velocity[i].xyz();
    }
};

TEST(MixedPrecision, AnImpactDiffersFromDoubleByTheRoundingOfTheLaw)
{
    for (double const offset : {0.0, 0.3, 1.0})
    {
        AfterImpact const exact("double", 0.9, 0.3, offset), mixed("mixed", 0.9, 0.3, offset);
        double const v = (mixed.velocity - exact.velocity).norm() / speed;
        double const w = r * (mixed.spin - exact.spin).norm() / speed;
        figure(fmt::format("mixed_impact_velocity_difference_{}", offset), v);
        figure(fmt::format("mixed_impact_spin_difference_{}", offset), w);
        // A force is off by some 1e-7; what turns the velocity round is their sum over 500 steps, in which random parts
        // cancel and common ones do not. 1e-6 is ten times what was found.
        EXPECT_LT(v, 1e-6) << offset;
        EXPECT_LT(w, 1e-6) << offset;
        EXPECT_GT(v + w, 1e-10) << offset;  // or it was double
    }
}

TEST(MixedPrecision, RestitutionIsThatOfDouble)
{
    double worst = 0;
    for (double const e : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0})
    {
        double const exact = -AfterImpact("double", e, 0, 0).velocity.x() / speed;
        double const mixed = -AfterImpact("mixed", e, 0, 0).velocity.x() / speed;
        // Test 3 of Chung and Ooi allows 1e-3; the scheme has that at 500 steps per contact.
        EXPECT_NEAR(mixed, e, 2e-3);
        EXPECT_NEAR(mixed, exact, 2e-7);  // some roundings of 6e-8
        worst = std::max(worst, std::abs(mixed - exact));
    }
    figure("mixed_restitution_worst_difference", worst);
    EXPECT_GT(worst, 1e-10);
}

TEST(MixedPrecision, SpheresTooSmallForSingleAreRefused)
{
    Case settings = bead_case();
    settings.dem.precision = "mixed";
    EXPECT_NO_THROW(OpenSpaceSystem(settings, {{{0, 0, 0}, 1.1e-5}}));
    EXPECT_THROW(OpenSpaceSystem(settings, {{{0, 0, 0}, 0.9e-5}}), gimdem::UserError);
}

}  // namespace

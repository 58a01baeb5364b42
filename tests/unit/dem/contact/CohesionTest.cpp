// SPDX-License-Identifier: BSD-3-Clause
#include "contact/Cohesion.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "ContactScene.hpp"
#include "contact/ContactLaws.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;
using std::numbers::pi;

TEST(Sjkr, AreaIsThatOfTheCircleInWhichTheSpheresCut)
{
    for (double const a : {1e-3, 2.5e-3})
        for (double const overlap : {1e-6, 1e-4, 5e-4})
        {
            double const b = 1e-3, d = a + b - overlap;
            ContactGeometry<double> contact{.normal = {1, 0, 0},
                                            .overlap = overlap,
                                            .velocity = {0, 0, 0},
                                            .radius_eff = a * b / (a + b),
                                            .mass_eff = 1,
                                            .per_distance = 1 / d};
            double const x = (d * d + a * a - b * b) / (2 * d);
            // The circle's radius^2 is a difference of squares: a^2 / (overlap a) times the rounding.
            EXPECT_NEAR(Sjkr::area(contact) / (pi * (a * a - x * x)), 1, 1e-12 * a / overlap);

            contact.radius_eff = a;
            contact.per_distance = 0;
            EXPECT_NEAR(Sjkr::area(contact) / (pi * (a * a - (a - overlap) * (a - overlap))), 1, 1e-12 * a / overlap);
        }
}

// A sphere on a wall, Hertz and SJKR: with s = sqrt(overlap), c = 4/3 E* sqrt(R) and p = pi k_c, the static force is
// c s^3 - p s^2 (2 R - s^2). It is zero where p s^2 + c s - 2 R p = 0, and most attractive where
// 4 p s^2 + 3 c s - 4 R p = 0.
constexpr double radius = 1e-3, energy_density = 1400;
double const c = 4.0 / 3 * 1.2e5 / (2 * (1 - 0.33 * 0.33)) * std::sqrt(radius), p = pi * energy_density;

TEST(Sjkr, SphereSticksToAWallAtTheOverlapOfEquilibrium)
{
    Case settings = bead_case(0.3, 0);
    settings.dem.cohesion = "sjkr";
    settings.contacts[0].cohesion_energy_density = energy_density;
    ContactScene scene(settings, {{{0.5, 0.5, radius - 5e-6}, radius}});

    scene.run(8000, 1e-5);

    double const s = (-c + std::sqrt(c * c + 8 * radius * p * p)) / (2 * p);
    EXPECT_NEAR((radius - scene.position(0).z()) / (s * s), 1, 1e-6);  // 13 periods, damped by 0.36 each radian
    EXPECT_LT(scene.velocity(0).norm(), 1e-9);
}

TEST(Sjkr, PullOffForceIsTheGreatestAttractionAtRest)
{
    using Law = ContactLaw<HertzMindlinLaw, NoRolling, Sjkr>;
    Case settings = bead_case(0.9, 0);
    settings.contacts[0].cohesion_energy_density = energy_density;
    auto const constants = Law::constants(settings.materials[0], settings.materials[0], settings.contacts[0]);
    double strongest = 0;
    for (double overlap = 1e-8; overlap < 2e-5; overlap += 1e-8)
    {
        ContactSprings<double> springs{};
        ContactGeometry<double> const contact{
            .normal = {0, 0, 1}, .overlap = overlap, .velocity = {0, 0, 0}, .radius_eff = radius, .mass_eff = 1};
        auto const out = Law::apply<double>(constants, 0, contact, springs);
        strongest = std::max(strongest, -out.force.z);
    }
    double const s = (-3 * c + std::sqrt(9 * c * c + 64 * radius * p * p)) / (8 * p);
    double const expected = p * s * s * (2 * radius - s * s) - c * s * s * s;
    EXPECT_NEAR(strongest / expected, 1, 1e-6);  // sampled 1e-3 apart around a maximum: second order
}

}  // namespace

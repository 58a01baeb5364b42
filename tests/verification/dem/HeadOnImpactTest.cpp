// SPDX-License-Identifier: BSD-3-Clause
/// Normal impacts: Chung and Ooi (2011) tests 1 to 3, and the restitution that comes out.
#include <gtest/gtest.h>

#include "Figure.hpp"
#include "HertzImpact.hpp"
#include "SphereBox.hpp"
#include "WallImpact.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::MaterialSettings;

MaterialSettings const glass{"glass", 2800, 4.8e10, 0.20}, limestone{"limestone", 2500, 2.0e10, 0.25};
MaterialSettings const aluminium{"aluminium", 2699, 7e10, 0.30}, magnesium{"magnesium", 1800, 4e10, 0.35};
MaterialSettings const alumina{"alumina", 4000, 3.8e11, 0.23}, cast_iron{"cast_iron", 7000, 1e11, 0.25};

/// Largest force [N] and overlap [m], duration [s], and the force on the way in.
struct PairImpact
{
    double force = 0, depth = 0, duration = 0;
    std::vector<std::array<double, 2>> loading;  ///< overlap [m], force [N]
};

/// Two spheres of radius 10 mm at 10 m/s each, without restitution losses, friction 0.35: test 1.
PairImpact meet_head_on(MaterialSettings const& material, int steps)
{
    double const r = 0.01;
    SphereBox scene(impact_case(material, material, 1, 0.35), {{0.4, 0.4, 0.4}, {}},
                    {{{0.2 - r, 0.2, 0.2}, r, {10, 0, 0}}, {{0.2 + r * (1 + 1e-9), 0.2, 0.2}, r, {-10, 0, 0}}});
    double const dt = HertzImpact::of_twins(material, r, 20).duration / steps;
    PairImpact out;
    for (int s = 0; s < 3 * steps / 2; ++s)
    {
        scene.run(1, dt);
        double const overlap = 2 * r - (scene.position(1) - scene.position(0)).norm();
        double const force = scene.force(0).norm();
        if (overlap > out.depth) out.loading.push_back({overlap, force});
        out.depth = std::max(out.depth, overlap);
        out.force = std::max(out.force, force);
        out.duration += overlap > 0 ? dt : 0;
    }
    return out;
}

TEST(HeadOnImpact, TwoSpheresAreThoseOfHertz)
{
    struct Reference
    {
        MaterialSettings material;
        double force, depth, duration;
    };
    for (Reference const& want :
         {Reference{glass, 10.6969e3, 274.113e-6, 40.339e-6}, Reference{limestone, 7.1082e3, 368.304e-6, 54.201e-6}})
    {
        int const steps = 2000;
        PairImpact const got = meet_head_on(want.material, steps);
        figure("two_spheres_" + want.material.name + "_force", got.force, "N");
        figure("two_spheres_" + want.material.name + "_depth", got.depth, "m");
        figure("two_spheres_" + want.material.name + "_duration", got.duration, "s");
        // The references have five digits or more: 1e-5. The scheme's error at 2000 steps per contact is below that.
        EXPECT_NEAR(got.force / want.force, 1, 2e-5);
        EXPECT_NEAR(got.depth / want.depth, 1, 2e-5);
        // Counted in steps.
        EXPECT_NEAR(got.duration / want.duration, 1, 2.0 / steps);
    }
}

TEST(HeadOnImpact, LoadingCurveIsThatOfThePublishedSimulations)
{
    // Force over overlap of test 1, glass, read off the published figure: reading errors up to 1 % of the largest
    // force.
    constexpr std::array<std::array<double, 2>, 8> published{{{29.05e-6, 450},
                                                              {73.81e-6, 1508},
                                                              {109.05e-6, 2702},
                                                              {148.1e-6, 4233},
                                                              {186.19e-6, 5966},
                                                              {217.14e-6, 7520},
                                                              {251.43e-6, 9366},
                                                              {265.24e-6, 10176}}};
    auto const curve = meet_head_on(glass, 2000).loading;
    double worst = 0;
    for (auto const& [overlap, force] : published)
    {
        auto const at = std::lower_bound(curve.begin(), curve.end(), overlap,
                                         [](auto const& point, double x) { return point[0] < x; });
        ASSERT_NE(at, curve.end());
        EXPECT_NEAR((*at)[1], force, 0.01 * 10.6969e3) << overlap;
        worst = std::max(worst, std::abs((*at)[1] - force) / 10.6969e3);
    }
    figure("two_spheres_loading_curve_deviation", worst);
}

TEST(HeadOnImpact, SphereOnARigidPlaneIsThatOfHertz)
{
    struct Reference
    {
        MaterialSettings material;
        double depth, force, duration;
    };
    for (Reference const& want : {Reference{aluminium, 49.7172e-6, 11.36986e3, 731.657e-6},
                                  Reference{magnesium, 52.1233e-6, 7.23268e3, 767.066e-6}})
    {
        int const steps = 2000;
        Rebound const got = rebound_of({want.material, rigid(), 1, 0, 0.1, 0.2}, steps);
        figure("rigid_plane_" + want.material.name + "_depth", got.depth, "m");
        figure("rigid_plane_" + want.material.name + "_force", got.force, "N");
        figure("rigid_plane_" + want.material.name + "_duration", got.duration, "s");
        // Six digits of the reference, and the scheme's error at 2000 steps per contact.
        EXPECT_NEAR(got.depth / want.depth, 1, 5e-6);
        EXPECT_NEAR(got.force / want.force, 1, 5e-6);
        EXPECT_NEAR(got.duration / want.duration, 1, 2.0 / steps);
    }
}

TEST(HeadOnImpact, StiffWallIsTheLimitOfStifferWalls)
{
    // The same with a wall only a thousand times stiffer: E* is 0.1 % smaller, within the digits of the reference.
    MaterialSettings wall = aluminium;
    wall.young_modulus *= 1000;
    Rebound const got = rebound_of({aluminium, wall, 1, 0, 0.1, 0.2});
    EXPECT_NEAR(got.depth / 49.7371e-6, 1, 5e-6);
    EXPECT_NEAR(got.force / 11.36531e3, 1, 5e-6);
}

TEST(HeadOnImpact, RestitutionIsWhatWasAskedFor)
{
    // Test 3: sphere of 2.5 mm at 3.9 m/s on a rigid plane, published tolerance 1e-3; here for every tenth.
    double worst = 0;
    for (MaterialSettings const& material : {alumina, cast_iron})
        for (double const e : {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0})
        {
            // The dashpot is of first order: its error at 4000 steps per contact is below 3e-4 for all e.
            double const got = rebound_of({material, rigid(), e, 0, 0.0025, 3.9}, 4000).normal_speed / 3.9;
            EXPECT_NEAR(got, e, 1e-3) << material.name;
            worst = std::max(worst, std::abs(got - e));
        }
    figure("restitution_worst_deviation", worst);
}

TEST(HeadOnImpact, RestitutionIsTheSameWithoutAttraction)
{
    double worst = 0;
    for (double const e : {0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0})
    {
        WallImpact impact{alumina, rigid(), e, 0, 0.0025, 3.9};
        impact.limit_damping = true;
        double const got = rebound_of(impact, 4000).normal_speed / 3.9;
        EXPECT_NEAR(got, e, 1e-3);  // as above
        worst = std::max(worst, std::abs(got - e));
    }
    figure("restitution_without_attraction_worst_deviation", worst);
}

}  // namespace

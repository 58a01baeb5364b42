// SPDX-License-Identifier: BSD-3-Clause
/// Oblique impacts on a plane: Chung and Ooi (2011) tests 4 and 5, MFIX-DEM's DEM05, and the closed form of sliding.
#include <gtest/gtest.h>

#include <numbers>

#include "Figure.hpp"
#include "WallImpact.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::MaterialSettings;

MaterialSettings const alumina{"alumina", 4000, 3.8e11, 0.23}, aluminium{"aluminium", 2700, 7e10, 0.33};

constexpr double degree = std::numbers::pi / 180;

/// A sphere of 2.5 mm at 3.9 m/s, `angle` [rad] from the normal.
Rebound at_angle(MaterialSettings const& bead, MaterialSettings const& wall, double restitution, double angle)
{
    return rebound_of({bead, wall, restitution, 0.092, 0.0025, 3.9 * std::cos(angle), 3.9 * std::sin(angle)});
}

/// Test 4: tangential restitution, spin [rad/s] and rebound angle of the contact point [degrees].
struct Outcome
{
    double degrees, restitution, spin, angle;
};

/// Read off the published figures; below 30 degrees models differ, so that part is compared with the next table.
constexpr std::array<Outcome, 8> published{{{30, .684, 616.5, -3.55},
                                            {35, .737, 582.3, 3.43},
                                            {40, .781, 544.8, 11.57},
                                            {50, .845, 457.0, 29.35},
                                            {60, .893, 357.5, 47.79},
                                            {70, .932, 246.2, 64.58},
                                            {80, .966, 126.3, 78.70},
                                            {85, .983, 63.1, 84.52}}};

/// An independent integration of the same law (spring in total form, tangential dashpot while it sticks).
constexpr std::array<Outcome, 13> integrated{{{5, .9509, 16.69, 4.229},
                                              {10, .7024, 201.6, -.430},
                                              {15, .6335, 370.0, -4.423},
                                              {20, .6227, 503.3, -6.790},
                                              {25, .6397, 593.8, -7.078},
                                              {30, .6845, 615.3, -3.517},
                                              {35, .7398, 582.05, 3.651},
                                              {40, .7829, 544.3, 11.615},
                                              {50, .8471, 456.7, 29.48},
                                              {60, .8948, 355.3, 48.156},
                                              {70, .9337, 243.0, 65.085},
                                              {80, .9679, 123.4, 78.98},
                                              {85, .9841, 61.93, 84.81}}};

Outcome of_test_4(MaterialSettings const& material, double degrees)
{
    Rebound const r = at_angle(material, rigid(), 0.98, degrees * degree);
    return {degrees, r.tangential / (3.9 * std::sin(degrees * degree)), r.spin,
            std::atan(r.surface / r.normal_speed) / degree};
}

TEST(ObliqueImpact, SpeedKeptAngleVariedIsThePublishedOne)
{
    for (Outcome const& want : published)
    {
        Outcome const got = of_test_4(alumina, want.degrees);
        // Tolerances of KRATOS' own comparison with the same digitised figures.
        EXPECT_NEAR(got.restitution, want.restitution, 1.6e-2 * want.restitution) << want.degrees;
        // For the spin also half a per cent of the figure's axis: at 80 degrees the closed form itself is 2.3 % below.
        EXPECT_NEAR(got.spin, want.spin, std::max(2.2e-2 * want.spin, 3.)) << want.degrees;
        // The angle crosses zero: 2.5 % of it, or 0.3 degrees, the width of a line in the figure.
        EXPECT_NEAR(got.angle, want.angle, std::max(2.5e-2 * std::abs(want.angle), 0.3)) << want.degrees;
    }
}

TEST(ObliqueImpact, SpeedKeptAngleVariedIsThatOfAnIndependentIntegrator)
{
    for (Outcome const& want : integrated)
    {
        Outcome const got = of_test_4(alumina, want.degrees);
        figure(fmt::format("oblique_{}_tangential_restitution", want.degrees), got.restitution);
        figure(fmt::format("oblique_{}_spin", want.degrees), got.spin, "rad/s");
        figure(fmt::format("oblique_{}_contact_angle", want.degrees), got.angle, "degrees");
        // Its lever and steps are not known to the digit: a lever tells 0.2 % of 600 rad/s.
        EXPECT_NEAR(got.restitution, want.restitution, 2e-3) << want.degrees;
        EXPECT_NEAR(got.spin, want.spin, 1) << want.degrees;
        EXPECT_NEAR(got.angle, want.angle, 0.06) << want.degrees;
    }
}

TEST(ObliqueImpact, GrossSlidingFollowsTheImpulseOfCoulomb)
{
    // tan(angle) >= 7/2 mu (1 + e): v_t' = v_t - mu (1 + e) v_n, R w' = 5/2 mu (1 + e) v_n.
    for (MaterialSettings const& material : {alumina, aluminium})
        for (double const degrees : {35., 45., 60., 75., 85.})
        {
            double const push = 0.092 * 2 * 3.9 * std::cos(degrees * degree);
            Rebound const r = at_angle(material, rigid(), 1, degrees * degree);
            double const v_t = 3.9 * std::sin(degrees * degree);
            // Until it slides the contact sticks, for less than 1e-3 of the impulse ...
            EXPECT_NEAR(r.tangential, v_t - push, 1e-3 * push) << material.name << degrees;
            // ... and the lever is R - overlap/2: 0 to 0.2 % (alumina) or 0.3 % (aluminium) shorter than R.
            EXPECT_NEAR(0.0025 * r.spin / (2.5 * push), 1 - r.depth / 0.0025 / 4, r.depth / 0.0025 / 4 + 1e-3);
        }
}

TEST(ObliqueImpact, AluminaOnGlassIsThatOfMfix)
{
    // MFIX-DEM's DEM05, e = 1: rebound angle of the centre [degrees], tangential restitution, spin [rad/s]. MFIX's
    // lever is R - overlap. A separate integration of the plane problem (20,000 steps per contact) gives MFIX's spins
    // with that lever and, with R - overlap/2, those in the last column; zero: not integrated.
    struct Reference
    {
        double degrees, angle, restitution, spin, spin_of_our_lever;
    };
    constexpr std::array<Reference, 11> references{{{1, .9970, .9970, .2013, .0345},
                                                    {5, 4.7015, .9400, 20.2515, 18.7751},
                                                    {10, 6.9401, .6903, 208.3846, 206.9500},
                                                    {15, 9.4858, .6236, 377.6207, 376.4470},
                                                    {20, 12.6178, .6150, 510.5268, 509.8518},
                                                    {25, 16.4771, .6343, 599.5303, 599.7074},
                                                    {30, 21.4722, .6813, 618.3861, 619.9230},
                                                    {35, 27.3031, .7372, 585.0427, 0},
                                                    {45, 39.2144, .8160, 505.2858, 0},
                                                    {60, 57.1386, .8938, 357.6565, 358.2282},
                                                    {65, 62.9751, .9142, 302.4259, 0}}};
    MaterialSettings const glass{"glass", 2500, 7e10, 0.25};
    for (Reference const& want : references)
    {
        Rebound const r = at_angle(alumina, glass, 1, want.degrees * degree);
        double const angle = std::atan(r.tangential / r.normal_speed) / degree;
        double const restitution = r.tangential / (3.9 * std::sin(want.degrees * degree));
        figure(fmt::format("dem05_{}_angle", want.degrees), angle, "degrees");
        figure(fmt::format("dem05_{}_tangential_restitution", want.degrees), restitution);
        figure(fmt::format("dem05_{}_spin", want.degrees), r.spin, "rad/s");
        // The lever's share: 0.6 %. Below 15 degrees the spin is what remains of pushes to and fro, 100 rad/s each.
        EXPECT_NEAR(angle, want.angle, 6e-3 * want.angle) << want.degrees;
        EXPECT_NEAR(restitution, want.restitution, 6e-3 * want.restitution) << want.degrees;
        EXPECT_NEAR(r.spin, want.spin, std::max(6e-3 * want.spin, 1.7)) << want.degrees;
        if (want.spin_of_our_lever == 0) continue;
        // Digits of the reference, and second order with 2000 steps per contact.
        EXPECT_NEAR(r.spin, want.spin_of_our_lever, std::max(5e-6 * want.spin, 2e-3)) << want.degrees;
    }
}

/// Test 5: sphere of 10 um at 5 m/s normal to the plane, friction 0.3, in units of mu v_n.
struct Sliding
{
    double before, surface, spin;
};

Sliding of_test_5(MaterialSettings const& material, double before)
{
    double const unit = 0.3 * 5;
    Rebound const r = rebound_of({material, rigid(), 1, 0.3, 1e-5, 5, before * unit});
    return {before, r.surface / unit, -1e-5 * r.spin / unit};
}

TEST(ObliqueImpact, NormalSpeedKeptIsExactWhereItSlides)
{
    MaterialSettings const steel{"steel", 7850, 2.08e11, 0.3}, polyethylene{"polyethylene", 1400, 1e9, 0.4};
    for (MaterialSettings const& material : {steel, polyethylene})
        for (double const before : {7.5, 8., 9.99, 12.96})
        {
            Sliding const got = of_test_5(material, before);
            figure(fmt::format("normal_speed_kept_{}_{}_surface", material.name, before), got.surface);
            figure(fmt::format("normal_speed_kept_{}_{}_spin", material.name, before), got.spin);
            // psi' = psi - 7 and R w'/(mu v_n) = -5 for the lever R; KRATOS allows 2 %. Ours is shorter by 0.3 % in
            // steel, 1.3 % in polyethylene, of which 5 parts in 7 go into psi'.
            EXPECT_NEAR(got.surface, before - 7, 0.02 * 5);
            EXPECT_NEAR(got.spin, -5, 0.02 * 5);
        }
}

TEST(ObliqueImpact, NormalSpeedKeptIsThePublishedOneAboveSix)
{
    MaterialSettings const steel{"steel", 7850, 2.08e11, 0.3};
    // Published curve of a DEM code for steel, read off; one per cent of its range of seven.
    for (auto const& [before, surface] : {std::pair{6., -1.013}, {9.99, 3.013}, {12.96, 6.013}})
        EXPECT_NEAR(of_test_5(steel, before).surface, surface, 0.07) << before;
    // Independent integration of the same law: the part that sticks depends on the model, so no code's figure will do.
    for (auto const& [before, surface] :
         {std::pair{.33, .317}, {1.009, .66}, {2., -.276}, {2.99, -.996}, {4., -1.399}, {5., -1.436}, {6., -.981}})
    {
        double const got = of_test_5(steel, before).surface;
        figure(fmt::format("normal_speed_kept_steel_{}_surface", before), got);
        EXPECT_NEAR(got, surface, 0.02) << before;
    }
}

}  // namespace

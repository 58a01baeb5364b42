// SPDX-License-Identifier: BSD-3-Clause
/// Order of the integrator, observed: impacts with 30, 60 and 120 steps per contact.
#include <gtest/gtest.h>

#include <numbers>

#include "Figure.hpp"
#include "WallImpact.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::MaterialSettings;

MaterialSettings const bead{"bead", 2500, 1e8, 0.3};

constexpr double r = 0.001, speed = 0.5;

/// What an impact in the plane gives.
struct Result
{
    double normal, tangential, spin;
};

/// One impact whose first contact lies `phase` of a step after a step.
Result impact(double restitution, double friction, double tangential, int steps, double phase)
{
    double const duration = HertzImpact::on_wall(bead, bead, r, speed).duration, dt = duration / steps;
    SphereBox scene(impact_case(bead, bead, restitution, friction), {{40 * r, 40 * r, 40 * r}, {"bottom"}},
                    {{{10 * r, 20 * r, r + (1 + phase) * speed * dt}, r, {tangential, 0, -speed}}});
    scene.run(2 * steps + 4, dt);
    return {scene.velocity(0).z() / speed, scene.velocity(0).x() / speed, r * scene.spin(0).y() / speed};
}

/// Root mean square over the phases of the difference from a computation 32 times finer.
double error(double restitution, double friction, double tangential, int steps)
{
    Result const exact = impact(restitution, friction, tangential, 32 * 120, 0.5);
    constexpr int phases = 16;
    double sum = 0;
    for (int p = 0; p < phases; ++p)
    {
        Result const got = impact(restitution, friction, tangential, steps, (p + 0.5) / phases);
        sum += std::pow(got.normal - exact.normal, 2) + std::pow(got.tangential - exact.tangential, 2) +
               std::pow(got.spin - exact.spin, 2);
    }
    return std::sqrt(sum / phases);
}

/// Mean order from 30 to 120 steps per contact; prints it and the errors.
double order(std::string const& name, double restitution, double friction, double tangential)
{
    std::array<double, 3> e{};
    for (std::size_t k = 0; k < 3; ++k)
    {
        int const steps = 30 << k;
        e[k] = error(restitution, friction, tangential, steps);
        figure(fmt::format("order_{}_error_{}", name, steps), e[k]);
    }
    double const observed = std::log2(e[0] / e[2]) / 2;
    figure("order_" + name, observed);
    return observed;
}

TEST(IntegratorOrder, ElasticImpactIsBetterThanSecondOrder)
{
    // What remains is the instant at which the force, overlap^(3/2), sets in: order 5/2.
    EXPECT_NEAR(order("elastic", 1, 0, 0), 2.5, 0.2);
    EXPECT_LT(error(1, 0, 0, 30), 2e-4);
}

TEST(IntegratorOrder, StickingImpactIsOfFirstOrder)
{
    // The spring is stretched by the whole of the step in which the contact begins, wherever in the step that is.
    EXPECT_NEAR(order("sticking", 1, 10, 0.3 * speed), 1, 0.2);
    EXPECT_LT(error(1, 10, 0.3 * speed, 30), 0.03);
}

TEST(IntegratorOrder, LossyImpactIsOfFirstOrder)
{
    // The dashpots see the speed of half a step ago.
    EXPECT_NEAR(order("lossy_0.9", 0.9, 0, 0), 1.2, 0.3);
    EXPECT_NEAR(order("lossy_0.5", 0.5, 0, 0), 1.2, 0.3);
    EXPECT_LT(error(0.9, 0, 0, 30), 2e-3);
}

}  // namespace

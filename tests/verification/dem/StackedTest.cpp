// SPDX-License-Identifier: BSD-3-Clause
/// Two spheres pressed between floor and ceiling: MFIX-DEM's DEM03 with Hertz contacts, against its own two equations
/// of motion integrated by the classical Runge-Kutta scheme.
#include <gtest/gtest.h>

#include <numbers>

#include "Figure.hpp"
#include "WallImpact.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::Case;
using gimdem::MaterialSettings;

constexpr double r = 0.5e-3, ceiling = 3.6 * r, g = 9.80665;

/// Heights and speeds of the two, and how they change.
using State = std::array<double, 4>;

struct Equations
{
    std::array<double, 2> mass;
    double young;  ///< E / (1 - nu^2) [Pa]; E* is half of it
    double damping;

    State operator()(State const& s) const
    {
        auto const [y1, y2, v1, v2] = s;
        double const floor = force(r - y1, v1, r, mass[0]);
        double const between = force(2 * r - (y2 - y1), v2 - v1, r / 2, mass[0] * mass[1] / (mass[0] + mass[1]));
        double const above = force(y2 + r - ceiling, -v2, r, mass[1]);
        return {v1, v2, (floor - between) / mass[0] - g, (between - above) / mass[1] - g};
    }

    /// Force of a contact that opens at the speed `opening`.
    double force(double overlap, double opening, double radius, double reduced) const
    {
        if (overlap <= 0) return 0;
        double const stiffness = young * std::sqrt(radius * overlap);  // S_n = 2 E* a
        return 2.0 / 3 * stiffness * overlap - damping * std::sqrt(stiffness * reduced) * opening;
    }

    State step(State const& s, double h) const
    {
        auto const at = [](State a, State const& slope, double f)
        {
            for (std::size_t i = 0; i < 4; ++i)
                a[i] += f * slope[i];
            return a;
        };
        State const k1 = (*this)(s), k2 = (*this)(at(s, k1, h / 2)), k3 = (*this)(at(s, k2, h / 2)),
                    k4 = (*this)(at(s, k3, h));
        return at(at(at(at(s, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
    }
};

/// Largest difference of heights from the equations' over 1 ms, in units of the first overlap.
double deviation(double restitution)
{
    // Lower sphere twice as dense; one material each, of equal elasticity: E* is that of the linear case's force at 0.1
    // r.
    MaterialSettings const heavy{"heavy", 2e4, 1e7, 0.3}, light{"light", 1e4, 1e7, 0.3};
    Case settings = impact_case(heavy, light, restitution, 0);
    settings.contacts.push_back({{"wall", "wall"}, restitution, 0});
    settings.dem.gravity = {0, 0, -g};
    // Half the start of the linear case would be near equilibrium: the lower one begins deeper in the floor.
    State s{0.23 * ceiling, 0.75 * ceiling, 0, 0};
    SphereBox scene(settings, {{20 * r, 20 * r, ceiling}, {"bottom", "top"}},
                    {{{10 * r, 10 * r, s[0]}, r}, {{10 * r, 10 * r, s[1]}, r}}, {0, 1});
    double const log_e = std::log(restitution);
    double const damping =
        2 * std::sqrt(5.0 / 6) * -log_e / std::sqrt(log_e * log_e + std::numbers::pi * std::numbers::pi);
    Equations const motion{{heavy.density * gimdem::sphere_volume(r), light.density * gimdem::sphere_volume(r)},
                           heavy.young_modulus / (1 - 0.09),
                           damping};
    double const dt = 5e-8;
    double worst = 0;
    for (int n = 0; n < 20000; ++n)
    {
        s = motion.step(s, dt);
        scene.run(1, dt);
        for (int i : {0, 1})
            worst = std::max(worst, std::abs(scene.position(i).z() - s[static_cast<std::size_t>(i)]));
    }
    return worst / (0.08 * ceiling);
}

TEST(Stacked, MotionIsThatOfTheEquations)
{
    double const elastic = deviation(1), lossy = deviation(0.8);
    figure("stacked_elastic_deviation", elastic);
    figure("stacked_lossy_deviation", lossy);
    // Second order with some hundred steps per swing; the dashpot is of first order. MFIX: 0.09 % of the height.
    EXPECT_LT(elastic, 1e-4);
    EXPECT_LT(lossy, 1e-3);
}

}  // namespace

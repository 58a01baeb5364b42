// SPDX-License-Identifier: BSD-3-Clause
/// What collisions keep: energy without losses, momentum and angular momentum always.
#include <gtest/gtest.h>

#include <numeric>

#include "Figure.hpp"
#include "WallImpact.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::Case;
using gimdem::MaterialSettings;
using gimdem::ParticleState;
using gimdem::Vec3;

MaterialSettings const bead{"bead", 1150, 1.2e5, 0.33};

/// Spheres of 0.8 to 1.2 mm on a lattice, moving at random.
std::vector<Sphere> cloud(int side, double spacing, Vec3 const& corner, double speed)
{
    std::vector<Sphere> spheres;
    auto const random = random_spheres(side * side * side, {0, 0, 0}, {1, 1, 1}, 0.8e-3, 1.2e-3);
    for (int n = 0; n < side * side * side; ++n)
    {
        Sphere s = random[static_cast<std::size_t>(n)];
        s.position = corner + spacing * (Vec3(n % side, n / side % side, n / side / side) + Vec3::Constant(0.5));
        s.velocity *= speed / 0.1;
        spheres.push_back(s);
    }
    return spheres;
}

/// Kinetic energy and what Hertz contacts hold, 2/5 k overlap^(5/2) [J]; walls of the same material.
double energy(SphereBox const& scene, double edge)
{
    ParticleState const& p = scene.particles();
    double const young = bead.young_modulus / (1 - bead.poisson_ratio * bead.poisson_ratio) / 2;
    auto const stored = [&](double radius_eff, double overlap)
    { return overlap > 0 ? 0.4 * 4.0 / 3 * young * std::sqrt(radius_eff) * std::pow(overlap, 2.5) : 0.; };
    double sum = 0;
    for (std::int64_t i = 0; i < p.count(); ++i)
    {
        Vec3 const x = p.position[i].xyz();
        double const r = p.position[i].w;
        sum += p.mass(i) * p.velocity[i].xyz().squaredNorm() / 2 +
               p.angular_velocity[i].xyz().squaredNorm() / p.angular_velocity[i].w / 2;
        for (int axis = 0; axis < 3; ++axis)
            sum += stored(r, r - x[axis]) + stored(r, r - (edge - x[axis]));
        for (std::int64_t j = i + 1; j < p.count(); ++j)
            sum += stored(r * p.position[j].w / (r + p.position[j].w),
                          r + p.position[j].w - (x - p.position[j].xyz()).norm());
    }
    return sum;
}

class ConservationIn : public testing::TestWithParam<char const*>
{
};

TEST_P(ConservationIn, EnergyDoesNotDriftWithoutLosses)
{
    // 125 spheres without friction fly about in a closed box for 1e5 steps.
    double const edge = 0.015, dt = 5e-6;
    Case settings = impact_case(bead, bead, 1, 0);
    settings.dem.precision = GetParam();
    fmt::print("precision = {}\n", GetParam());
    SphereBox scene(settings, {{edge, edge, edge}, closed()}, cloud(5, edge / 5, Vec3::Zero(), 0.3));
    double const before = energy(scene, edge);
    double worst = 0;
    for (int n = 0; n < 100; ++n)
    {
        scene.run(1000, dt);
        worst = std::max(worst, std::abs(energy(scene, edge) / before - 1));
    }
    double const drift = energy(scene, edge) / before - 1;
    figure("energy_drift_after_1e5_steps", drift);
    figure("energy_largest_deviation", worst);
    figure("energy_list_rebuilds", static_cast<double>(scene.system().rebuilds()));
    EXPECT_LT(worst, 1e-4);
    EXPECT_GT(scene.system().rebuilds(), 100);  // they did move about
}

INSTANTIATE_TEST_SUITE_P(Precision, ConservationIn, testing::Values("double", "mixed"));

/// Sums over all particles, and of the magnitudes they are made of.
struct Totals
{
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
    double momentum_scale = 0, angular_scale = 0;
};

Totals totals(SphereBox const& scene, Vec3 const& pole)
{
    Totals t;
    ParticleState const& p = scene.particles();
    for (std::int64_t i = 0; i < p.count(); ++i)
    {
        Vec3 const momentum = p.velocity[i].xyz() / p.velocity[i].w;
        Vec3 const angular =
            (p.position[i].xyz() - pole).cross(momentum) + p.angular_velocity[i].xyz() / p.angular_velocity[i].w;
        t.momentum += momentum;
        t.angular += angular;
        t.momentum_scale += momentum.norm();
        t.angular_scale += angular.norm();
    }
    return t;
}

TEST(Conservation, MomentumAndAngularMomentumAreKeptToRounding)
{
    // A cloud of 216 spheres of different sizes that implodes in free space, with friction and losses.
    auto spheres = cloud(6, 2.6e-3, Vec3::Constant(0.05), 0.3);
    Vec3 const centre = Vec3::Constant(0.05 + 3 * 2.6e-3);
    for (Sphere& s : spheres)
        s.velocity -= 60 * (s.position - centre);
    SphereBox scene(impact_case(bead, bead, 0.7, 0.4), {{0.12, 0.12, 0.12}, {}}, spheres);
    Totals const before = totals(scene, centre);
    scene.run(4000, 1e-5);
    Totals const after = totals(scene, centre);
    double const linear = (after.momentum - before.momentum).norm() / before.momentum_scale;
    double const angular = (after.angular - before.angular).norm() / before.angular_scale;
    double spun = 0;
    for (int i = 0; i < 216; ++i)
        spun = std::max(spun, (scene.spin(i) - spheres[static_cast<std::size_t>(i)].angular_velocity).norm());
    figure("momentum_change", linear);
    figure("angular_momentum_change", angular);
    figure("momentum_largest_change_of_spin", spun, "rad/s");
    // Rounding: 1e-16 a kick for 4000 steps adds up at random to 1e-14; levers of 1 mm from positions of 0.1 m: 100
    // times.
    EXPECT_LT(linear, 1e-13);
    EXPECT_LT(angular, 1e-12);
    EXPECT_GT(spun, 100);  // they did meet and rub
}

}  // namespace

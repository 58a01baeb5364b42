// SPDX-License-Identifier: BSD-3-Clause
/// Stiff couplings, where one solver after the other diverges and the iterated schedule finds the implicit solution,
/// theory.md (C.14)-(C.18). The fluid is one body, so that this solution has a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "CoupledCloud.hpp"
#include "Figure.hpp"
#include "gimdem/coupling/FixedPoint.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

/// What the particles see of the fluid, along x.
struct Fluid
{
    double velocity = 0;           ///< [m/s]
    double pressure_gradient = 0;  ///< [Pa/m]
};

/// The fluid at the end of a step that comes of the particles' answer to a fluid.
using FluidStep = std::function<Fluid(CoupledCloud const& cloud, Fluid const& seen_by_particles)>;

/// One coupling step of the schedule iterated; returns the fluid at its end.
Fluid iterate(CoupledCloud& cloud, coupling::Step const& step, Fluid const& begin, FluidStep const& solve,
              coupling::Iteration const& settings, int& passes)
{
    coupling::FluidFixedPoint fixed_point(settings);
    Fluid seen = begin, end;
    cloud.set_fluid(begin.velocity, begin.pressure_gradient);
    fixed_point.start(cloud.fluid());
    cloud.engine->remember();
    while (true)
    {
        cloud.advance(step, seen.velocity, seen.pressure_gradient);
        end = solve(cloud, seen);
        cloud.set_fluid(end.velocity, end.pressure_gradient);
        if (!fixed_point.improve(cloud.fluid())) break;
        seen = {fixed_point.guess().velocity[0], fixed_point.guess().pressure_gradient[0]};
        cloud.engine->go_back();
    }
    EXPECT_TRUE(fixed_point.converged()) << "residual " << fixed_point.residual();
    passes = fixed_point.passes();
    return end;
}

constexpr coupling::Iteration strict{1e-10, 20, 0.5, true};

/// How much of its slip a particle keeps over a step of n DEM steps, each of two half kicks with implicit drag (D.13).
double kept_slip(CoupledCloud const& cloud, double dt, double coefficient)
{
    double const n = std::ceil(dt / CoupledCloud::dem_step - 1e-9);
    return std::pow(1 + coefficient * dt / (2 * n * cloud.mass()), -2 * n);
}

// Heavy load: particles of five times the fluid's mass, which come to its velocity within the step. One after the
// other they hand the slip back and forth, and it grows: by 1 - (1 + r)(1 - E) a step, (C.14).
class HeavyLoad : public testing::Test
{
protected:
    static constexpr double load = 5, dt = 3e-3;
    // So slow that the drag is linear: its inertial part is 1e-8 of it, (D.17) at Re = 1e-6.
    static constexpr double start = 1e-3;  ///< [m/s]

    static CoupledCloud::Properties properties()
    {
        double const solid = 64 * sphere_volume(5e-4), fluid = CoupledCloud::volume - solid;
        return {.particle_density = load * fluid / solid, .viscosity = 1};
    }
    /// Momentum as it is exchanged, no part of it implicit.
    static Fluid push(CoupledCloud const& cloud, Fluid const& seen, double from)
    {
        return {from + dt * cloud.force_on_fluid(seen.velocity) / cloud.fluid_mass(), 0};
    }
};

TEST_F(HeavyLoad, DivergesOneAfterTheOtherAsTheFactorSays)
{
    CoupledCloud cloud(properties());
    double const kept = kept_slip(cloud, dt, cloud.drag_coefficient());
    double const factor = 1 - (1 + load) * (1 - kept);
    ASSERT_LT(factor, -2);
    Fluid fluid{start, 0};
    for (int n = 1; n <= 4; ++n)
    {
        double const before = fluid.velocity - cloud.velocity();
        cloud.advance({n, (n - 1) * dt, dt}, fluid.velocity);
        fluid = push(cloud, fluid, fluid.velocity);
        // The inertial part of the drag grows with the slip, to 1e-6 of it.
        EXPECT_NEAR((fluid.velocity - cloud.velocity()) / before / factor, 1, 1e-5);
    }
    EXPECT_GT(std::abs(fluid.velocity - cloud.velocity()), 50 * start);
}

TEST_F(HeavyLoad, ComesToTheImplicitSolutionWhenIterated)
{
    CoupledCloud cloud(properties());
    double const kept = kept_slip(cloud, dt, cloud.drag_coefficient());
    Fluid fluid{start, 0};
    int most_passes = 0;
    for (int n = 1; n <= 4; ++n)
    {
        double const fluid_before = fluid.velocity, particles_before = cloud.velocity();
        int passes = 0;
        fluid = iterate(
            cloud, {n, (n - 1) * dt, dt}, fluid,
            [&](CoupledCloud const& c, Fluid const& seen) { return push(c, seen, fluid_before); }, strict, passes);
        most_passes = std::max(most_passes, passes);

        double const common = load * (1 - kept);
        double const expected = (fluid_before + common * particles_before) / (1 + common);
        EXPECT_NEAR(fluid.velocity, expected, 1e-7 * start) << "step " << n;
        double const momentum = cloud.fluid_mass() * (fluid.velocity - fluid_before) +
                                64 * cloud.mass() * (cloud.velocity() - particles_before);
        // What the tolerance leaves, times the load and the slope.
        EXPECT_NEAR(momentum / (cloud.fluid_mass() * start), 0, 1e-8) << "step " << n;
    }
    // A linear problem needs two passes and one to see that it is solved; the drag is not quite linear.
    EXPECT_LE(most_passes, 5);
    figure("iterated_heavy_load_passes", most_passes);
}

// Light particles in liquid: what accelerates them pushes the liquid the other way, whose pressure gradient answers
// with rho_f/rho_p phi/alpha times their acceleration (C.19): 12 times, of the other sign, whatever the time step.
class LightParticles : public testing::Test
{
protected:
    static constexpr double dt = 2e-5, g = -9.81;
    static CoupledCloud::Properties properties()
    {
        return {.radius = 4.5e-3,
                .particle_density = 50,
                .fluid_density = 1000,
                .viscosity = 1e-1,
                .gravity = g,
                .pressure_gradient = true};
    }

    LightParticles() : cloud(properties())
    {
        solid = cloud.solid_volume() / CoupledCloud::volume;
        beta = solid / (1 - solid);
    }

    /// Fluid of which no volume leaves the box, and the pressure gradient that its momentum needs (F.2). `u`: of the
    /// particles when the step began.
    Fluid answer(Fluid const& seen, double u, double* velocity = nullptr) const
    {
        double const source = cloud.force_on_fluid(seen.velocity) / CoupledCloud::volume;
        double const end = u + dt * (g - seen.pressure_gradient / 50 - source / (solid * 50));
        if (velocity != nullptr) *velocity = end;
        return {-beta * end, 1000 * g + 1000 * beta * (end - u) / dt + source / (1 - solid)};
    }

    /// The same at the new level: two linear equations for the particles' velocity and the pressure gradient.
    ///   u' = E u + (1 - E)(-beta u' + tau (g - P / rho_p)),    tau = m / k
    ///   P = rho_f g + rho_f beta (u' - u) / dt + S / (1 - phi),  S = phi rho_p (g - P / rho_p - (u' - u) / dt)
    Fluid implicit(double u, double& end) const
    {
        double const k = cloud.drag_coefficient(), tau = cloud.mass() / k, kept = kept_slip(cloud, dt, k);
        double const a11 = 1 + (1 - kept) * beta, a12 = (1 - kept) * tau / 50, b1 = kept * u + (1 - kept) * tau * g;
        double const a21 = -(1000 * beta - beta * 50) / dt, a22 = 1 + beta,
                     b2 = 1000 * g + beta * 50 * g - (1000 * beta - beta * 50) * u / dt;
        double const determinant = a11 * a22 - a12 * a21;
        end = (b1 * a22 - a12 * b2) / determinant;
        return {-beta * end, (a11 * b2 - a21 * b1) / determinant};
    }

    CoupledCloud cloud;
    double solid, beta;
};

TEST_F(LightParticles, DivergeOneAfterTheOther)
{
    double const factor = 1000 * beta / 50;
    ASSERT_GT(factor, 10);
    Fluid fluid{0, 1000 * g};
    double before = 0, u = 0;
    for (int n = 1; n <= 4; ++n)
    {
        cloud.advance({n, (n - 1) * dt, dt}, fluid.velocity, fluid.pressure_gradient);
        Fluid const next = answer(fluid, u);
        u = cloud.velocity();
        double const change = next.pressure_gradient - fluid.pressure_gradient;
        // Drag takes a part of it, which is small in so short a step.
        if (n > 1)
        {
            EXPECT_NEAR(change / before, -factor, 0.3 * factor) << "step " << n;
        }
        before = change;
        fluid = next;
    }
    EXPECT_GT(std::abs(fluid.pressure_gradient), 1000 * std::abs(1000 * g));
}

TEST_F(LightParticles, RiseAsTheImplicitSolutionDoesWhenIterated)
{
    Fluid fluid{0, 1000 * g};
    int most_passes = 0;
    for (int n = 1; n <= 10; ++n)
    {
        double const u = cloud.velocity();
        int passes = 0;
        fluid = iterate(
            cloud, {n, (n - 1) * dt, dt}, fluid,
            [&](CoupledCloud const&, Fluid const& seen) { return answer(seen, u); }, strict, passes);
        most_passes = std::max(most_passes, passes);

        double end = 0;
        Fluid const expected = implicit(u, end);
        // The cloud moves by 1e-4 of its radius, and the drag is linear to 1e-3 of it in the step's share of 1e-2.
        EXPECT_NEAR(cloud.velocity() / end, 1, 1e-4) << "step " << n;
        EXPECT_NEAR(fluid.velocity / expected.velocity, 1, 1e-4) << "step " << n;
        EXPECT_NEAR(fluid.pressure_gradient / expected.pressure_gradient, 1, 1e-4) << "step " << n;
    }
    // Upwards, with the acceleration of the buoyancy on the particles and the liquid that they move:
    // (rho_f - rho_p)(-g) / (rho_p + rho_f beta), less what drag takes.
    double const free = 950 * -g / (50 + 1000 * beta);
    EXPECT_GT(cloud.velocity(), 0.8 * free * 10 * dt);
    EXPECT_LT(cloud.velocity(), free * 10 * dt);
    // Two numbers: the pressure gradient has a slope of -12, the velocity hardly one, and one factor has to serve both.
    // In these linear equations that takes 9 to 12 passes to 1e-10.
    EXPECT_LE(most_passes, 14);
    figure("iterated_light_particles_passes", most_passes);
}

}  // namespace

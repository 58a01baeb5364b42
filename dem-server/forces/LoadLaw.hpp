// SPDX-License-Identifier: BSD-3-Clause
/// The fluid's load on a particle as a function of the fluid in its cell, theory.md (D.15)-(D.18).
#pragma once

#include <cstdint>

#include "forces/Beetstra.hpp"
#include "forces/FluidForces.hpp"

namespace gimdem
{

/// The fluid per cell, as kernels see it.
struct FluidView
{
    Quad const* velocity;
    double const* velocity_gradient;
    Quad const* pressure_gradient;
    Quad const* void_gradient;
    double density, viscosity;

    /// v_i + grad v_i . (x - x_i), theory.md (D.15).
    GIMDEM_HD Vec3 velocity_at(std::int32_t cell, Vec3 const& dx) const
    {
        double const* const g = velocity_gradient + 9 * static_cast<std::int64_t>(cell);
        return velocity[cell].xyz() + Vec3(dx.x() * g[0] + dx.y() * g[3] + dx.z() * g[6],
                                           dx.x() * g[1] + dx.y() * g[4] + dx.z() * g[7],
                                           dx.x() * g[2] + dx.y() * g[5] + dx.z() * g[8]);
    }

    /// Void fraction at dx from the centre of a cell, Eq. 25, clipped into [minimum, 1]; tells whether it was.
    GIMDEM_HD double void_fraction_at(std::int32_t cell, double at_centre, Vec3 const& dx, double minimum,
                                      bool& was_clipped) const
    {
        double const linear = at_centre + void_gradient[cell].xyz().dot(dx);
        double const e = linear < minimum ? minimum : (linear > 1 ? 1.0 : linear);
        was_clipped = e != linear;
        return e;
    }

    /// k [kg/s] of F_d = k (v_f - v_p), (D.16), at a slip [m/s] and a diameter [m]. Real is double or exec::Octet.
    template <class Real>
    GIMDEM_HD Real drag_coefficient(Real const& e, Real const& slip, Real const& diameter) const
    {
        constexpr double pi = 3.14159265358979323846;
        Real const reynolds = e * density * slip * diameter / viscosity;
        return 3 * pi * viscosity * diameter * e * beetstra_factor(e, reynolds);
    }
};

/// Load of one particle.
struct ParticleLoadKernel
{
    Quad const* position;
    Quad const* particle_velocity;
    std::int32_t const* cell_of;
    Quad const* cell;
    double const* void_fraction;
    FluidView fluid;
    double void_fraction_minimum;
    bool drag, pressure_gradient;
    FluidLoad* loads;
    std::int32_t* clips;  ///< counts how often the void fraction was clipped

    GIMDEM_HD void operator()(std::int64_t p) const
    {
        Quad const x = position[p];
        std::int32_t const c = cell_of[p];
        FluidLoad load{{0, 0, 0, 0}, {0, 0, 0, 0}};
        if (pressure_gradient) load.steady = Quad::of(-sphere_volume(x.w) * fluid.pressure_gradient[c].xyz(), 0);
        if (drag)
        {
            Vec3 const dx = x.xyz() - cell[c].xyz();
            bool was_clipped = false;
            double const e = fluid.void_fraction_at(c, void_fraction[c], dx, void_fraction_minimum, was_clipped);
            clips[p] += was_clipped;
            Vec3 const v = fluid.velocity_at(c, dx);
            double const slip = (v - particle_velocity[p].xyz()).norm();
            load.fluid_velocity = Quad::of(v, fluid.drag_coefficient(e, slip, 2 * x.w));
        }
        loads[p] = load;
    }
};

}  // namespace gimdem

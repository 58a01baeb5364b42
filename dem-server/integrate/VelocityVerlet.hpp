// SPDX-License-Identifier: BSD-3-Clause
/// Velocity Verlet with rotation, theory.md (D.13): half kick, drift, forces, half kick. The drag enters each half kick
/// implicitly, so that no drag is too stiff for the time step.
#pragma once

#include "exec/Buffer.hpp"
#include "exec/Vector.hpp"
#include "forces/FluidForces.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// v <- v at the end of half a step h of the acceleration force/m + g + (k/m)(v_f - v), the drag taken at the end.
/// With `fluid` false there are no loads and no impulses.
template <bool fluid>
struct HalfKick
{
    ParticleView particles;
    FluidLoad const* loads;
    Impulse* impulses;
    Quad gravity;  ///< [m/s^2], w: 0
    double h;      ///< half the time step [s]

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        Quad& v = particles.velocity[i];
        double const inverse_mass = v.w;
        if constexpr (fluid)
        {
            FluidLoad const& load = loads[i];
            double const k = load.fluid_velocity.w;
            Quad const v_f = {load.fluid_velocity.x, load.fluid_velocity.y, load.fluid_velocity.z, 0};
            Quad const force = particles.force[i] + load.steady;
            Quad const kicked = v + h * (inverse_mass * force + gravity) + (h * k * inverse_mass) * v_f;
            v = 1 / (1 + h * k * inverse_mass) * kicked;
            v.w = inverse_mass;
            Quad drag = (h * k) * (v_f - v);
            drag.w = h * k;
            impulses[i].drag = impulses[i].drag + drag;
        }
        else
            v = v + h * (inverse_mass * particles.force[i] + gravity);

        Quad& spin = particles.angular_velocity[i];
        spin = spin + (h * spin.w) * particles.torque[i];
    }
};

/// x <- x + dt v.
struct Drift
{
    ParticleView particles;
    double dt;  ///< [s]

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        Quad& x = particles.position[i];
        Quad step = dt * particles.velocity[i];
        step.w = 0;
        x = x + step;
    }
};

}  // namespace gimdem

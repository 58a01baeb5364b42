// SPDX-License-Identifier: BSD-3-Clause
/// Velocity Verlet with rotation, theory.md (D.13): half kick, drift, forces, half kick. The drag enters each half kick
/// implicitly, so that no drag is too stiff for the time step.
#pragma once

#include "exec/Buffer.hpp"
#include "integrate/Kick.hpp"
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

    // All is read before anything is written: arrays that begin at the same place of a page would hold up each other.
    GIMDEM_HD void operator()(std::int64_t i) const
    {
        Quad const force = particles.force[i], torque = particles.torque[i], spin = particles.angular_velocity[i];
        Quad v = particles.velocity[i];
        if constexpr (fluid)
            v = kicked(v, force, loads[i], gravity, h, impulses[i].drag);
        else
            v = kicked(v, force, gravity, h);
        particles.velocity[i] = v;
        particles.angular_velocity[i] = spun(spin, torque, h);
    }
};

/// x <- x + dt v.
struct Drift
{
    ParticleView particles;
    double dt;  ///< [s]

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        particles.position[i] = drifted(particles.position[i], particles.velocity[i], dt);
    }
};

}  // namespace gimdem

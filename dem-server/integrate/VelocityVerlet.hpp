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
struct HalfKick
{
    ParticleView particles;
    Quad const* wall_force;  ///< part of `force`, for the balance
    FluidLoad const* loads;  ///< null: no fluid
    Impulse* impulses;
    Constant3 gravity;  ///< [m/s^2]
    double h;           ///< half the time step [s]

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        Quad& v = particles.velocity[i];
        Vec3 force = particles.force[i].xyz();
        Impulse& impulse = impulses[i];
        impulse.wall.set_xyz(impulse.wall.xyz() + h * wall_force[i].xyz());
        if (loads != nullptr)
        {
            FluidLoad const& load = loads[i];
            double const k = load.fluid_velocity.w;
            Vec3 const v_f = load.fluid_velocity.xyz();
            force += load.steady.xyz();
            Vec3 const kicked = v.xyz() + h * (force * v.w + gravity.vec()) + h * k * v.w * v_f;
            v.set_xyz(kicked / (1 + h * k * v.w));
            impulse.drag = Quad::of(impulse.drag.xyz() + h * k * (v_f - v.xyz()), impulse.drag.w + h * k);
        }
        else
            v.set_xyz(v.xyz() + h * (force * v.w + gravity.vec()));

        Quad& spin = particles.angular_velocity[i];
        spin.set_xyz(spin.xyz() + h * spin.w * particles.torque[i].xyz());
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
        x.set_xyz(x.xyz() + dt * particles.velocity[i].xyz());
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// What half a step does to one particle's velocities, theory.md (D.13): pure functions that every kernel of motion
/// shares.
#pragma once

#include "exec/Vector.hpp"
#include "forces/FluidForces.hpp"

namespace gimdem
{

/// Velocity [m/s] after a time h [s] under force/m + g; w is 1/m [1/kg], and stays. gravity and force have w = 0.
GIMDEM_HD inline Quad kicked(Quad const& velocity, Quad const& force, Quad const& gravity, double h)
{
    return velocity + h * (velocity.w * force + gravity);
}

/// The same with the fluid's load. The drag (k/m)(v_f - v) is taken at the end of h, so that none is too stiff for the
/// step; its impulse is added to `impulse`.
GIMDEM_HD inline Quad kicked(Quad const& velocity, Quad const& force, FluidLoad const& load, Quad const& gravity,
                             double h, Quad& impulse)
{
    double const inverse_mass = velocity.w;
    double const k = load.fluid_velocity.w;
    Quad const v_f = {load.fluid_velocity.x, load.fluid_velocity.y, load.fluid_velocity.z, 0};
    Quad const pushed = velocity + h * (inverse_mass * (force + load.steady) + gravity) + (h * k * inverse_mass) * v_f;
    Quad v = 1 / (1 + h * k * inverse_mass) * pushed;
    v.w = inverse_mass;
    Quad drag = (h * k) * (v_f - v);
    drag.w = h * k;
    impulse = impulse + drag;
    return v;
}

/// Angular velocity [rad/s] after h; w is 1/I [1/(kg m^2)], and stays.
GIMDEM_HD inline Quad spun(Quad const& spin, Quad const& torque, double h)
{
    return spin + (h * spin.w) * torque;
}

/// Position [m] after dt [s]; w, the radius, stays.
GIMDEM_HD inline Quad drifted(Quad const& position, Quad const& velocity, double dt)
{
    Quad step = dt * velocity;
    step.w = 0;
    return position + step;
}

}  // namespace gimdem

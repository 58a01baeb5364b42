// SPDX-License-Identifier: BSD-3-Clause
/// From one sum of forces to the next in one kernel: the second half kick of a step, the first of the next one, the
/// drift, and the test whether the list of pairs still holds. One pass over the particles instead of four, with the
/// same operations in the same order as HalfKick and Drift.
#pragma once

#include <cstdint>

#include "integrate/Kick.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// Raises a flag where a particle moved more than half the skin since the list was built. All that raise it write the
/// same.
struct StaleTest
{
    Quad const* built_at;  ///< positions when the list was built [m]
    double skin;           ///< [m]
    std::int32_t* stale;

    GIMDEM_HD void operator()(std::int64_t i, Quad const& now) const
    {
        double const moved2 = (now.xyz() - built_at[i].xyz()).squaredNorm();
        if (!(4 * moved2 <= skin * skin)) *stale = 1;  // a NaN must not hide
    }
};
struct StaleKernel
{
    Quad const* position;
    StaleTest test;

    GIMDEM_HD void operator()(std::int64_t i) const { test(i, position[i]); }
};

template <bool fluid>
struct MotionKernel
{
    ParticleView particles;
    FluidLoad const* loads;  ///< null without fluid
    Impulse* impulses;
    Quad gravity;    ///< [m/s^2], w: 0
    double owed;     ///< half step that the step before has left to do [s]; 0: none
    double h;        ///< half of this one's step [s]
    StaleTest test;  ///< built_at null: no list yet

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        Quad v = particles.velocity[i], spin = particles.angular_velocity[i];
        Quad const force = particles.force[i], torque = particles.torque[i];
        if constexpr (fluid)
        {
            FluidLoad const load = loads[i];
            Quad impulse = impulses[i].drag;
            if (owed > 0) v = kicked(v, force, load, gravity, owed, impulse);
            v = kicked(v, force, load, gravity, h, impulse);
            impulses[i].drag = impulse;
        }
        else
        {
            if (owed > 0) v = kicked(v, force, gravity, owed);
            v = kicked(v, force, gravity, h);
        }
        if (owed > 0) spin = spun(spin, torque, owed);
        spin = spun(spin, torque, h);
        Quad const x = drifted(particles.position[i], v, 2 * h);
        particles.velocity[i] = v;
        particles.angular_velocity[i] = spin;
        particles.position[i] = x;
        if (test.built_at != nullptr) test(i, x);
    }
};

/// Does nothing while a flag is raised: for what was asked for before the host knows of the flag.
template <class Kernel>
struct Unless
{
    std::int32_t const* flag;
    Kernel kernel;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        if (*flag == 0) kernel(i);
    }
};
template <class Kernel>
Unless(std::int32_t const*, Kernel) -> Unless<Kernel>;

}  // namespace gimdem

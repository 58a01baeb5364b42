// SPDX-License-Identifier: BSD-3-Clause
/// Small cases and particles for tests of the particle side.
#pragma once

#include <random>
#include <vector>

#include "core/Case.hpp"
#include "exec/Execution.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem::test
{

inline constexpr exec::Execution serial{exec::Backend::serial, 1};

/// One material called "bead", no gravity, no fluid forces.
inline Case bead_case(double restitution = 0.9, double friction = 0.3)
{
    Case settings;
    settings.dem.time_step = 1e-6;
    settings.dem.skin = 0.2;
    settings.materials = {{"bead", 1150, 1.2e5, 0.33}};
    settings.contacts = {{{"bead", "bead"}, restitution, friction}};
    settings.walls.material = "bead";
    return settings;
}

struct Sphere
{
    Vec3 position;
    double radius;
    Vec3 velocity = Vec3::Zero();
    Vec3 angular_velocity = Vec3::Zero();
};

inline ParticleState particles_of(std::vector<Sphere> const& spheres, double density = 1150)
{
    ParticleState state;
    state.resize(static_cast<std::int64_t>(spheres.size()));
    for (std::int64_t i = 0; i < state.count(); ++i)
    {
        Sphere const& s = spheres[static_cast<std::size_t>(i)];
        double const mass = density * sphere_volume(s.radius);
        state.position[i] = Quad::of(s.position, s.radius);
        state.velocity[i] = Quad::of(s.velocity, 1 / mass);
        state.angular_velocity[i] = Quad::of(s.angular_velocity, 1 / (0.4 * mass * s.radius * s.radius));
        state.force[i] = state.torque[i] = {0, 0, 0, 0};
        state.material[i] = 0;
        state.id[i] = i;
    }
    return state;
}

/// `count` spheres of radius in [smallest, largest] at random in a box; they may overlap.
inline std::vector<Sphere> random_spheres(int count, Vec3 const& low, Vec3 const& high, double smallest, double largest,
                                          unsigned seed = 7)
{
    std::mt19937_64 random(seed);
    auto const uniform = [&](double a, double b)
    { return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<Sphere> spheres;
    for (int i = 0; i < count; ++i)
    {
        double const radius = uniform(smallest, largest);
        Vec3 x, v, w;
        for (int axis = 0; axis < 3; ++axis)
        {
            x[axis] = uniform(low[axis] + radius, high[axis] - radius);
            v[axis] = uniform(-0.1, 0.1);
            w[axis] = uniform(-10, 10);
        }
        spheres.push_back({x, radius, v, w});
    }
    return spheres;
}

}  // namespace gimdem::test

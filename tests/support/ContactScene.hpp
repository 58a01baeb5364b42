// SPDX-License-Identifier: BSD-3-Clause
/// A few spheres in a box, stepped by the whole engine: for tests of contact laws.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "engine/DemSystem.hpp"

namespace gimdem::test
{

/// One material "bead" for spheres and walls; linear contacts, no friction unless it is set.
inline Case linear_case(double stiffness, double restitution, double density, double friction = 0)
{
    Case settings = bead_case(restitution, friction);
    settings.materials = {{"bead", density, 1e7, 0.3}};
    settings.dem.contact_law = "linear";
    settings.contacts[0].normal_stiffness = stiffness;
    return settings;
}

/// Spheres in a box with walls all around. Materials of the spheres: all 0, or as given.
struct ContactScene
{
    ContactScene(Case const& given, std::vector<Sphere> const& spheres, BoxMesh::Lengths box = {1, 1, 1},
                 std::vector<std::int32_t> const& material = {}, exec::Execution execution = serial)
        : settings(given),
          materials(settings),
          mesh(BoxMesh::make({1, 1, 1}, box)),
          walls(mesh, {"bottom", "top"}, 0.2 * box[2]),
          system(settings, execution, materials, walls, make(spheres, material))
    {
        system.prepare();
        system.begin_coupling_step(nullptr);
    }

    Vec3 position(std::int64_t id) const { return find(system.particles().position, id); }
    Vec3 velocity(std::int64_t id) const { return find(system.particles().velocity, id); }
    Vec3 spin(std::int64_t id) const { return find(system.particles().angular_velocity, id); }

    void run(std::int64_t steps, double dt)
    {
        for (std::int64_t s = 0; s < steps; ++s)
            system.step(dt);
    }

    Case settings;
    Materials materials;
    PolyMesh mesh;
    WallGeometry walls;
    DemSystem system;

private:
    ParticleState make(std::vector<Sphere> const& spheres, std::vector<std::int32_t> const& material) const
    {
        ParticleState state = particles_of(spheres, settings.materials[0].density);
        for (std::int64_t i = 0; i < state.count() && !material.empty(); ++i)
        {
            state.material[i] = material[static_cast<std::size_t>(i)];
            double const share = settings.materials[0].density / materials[state.material[i]].density;
            state.velocity[i].w *= share;
            state.angular_velocity[i].w *= share;
        }
        return state;
    }
    Vec3 find(exec::Buffer<Quad> const& values, std::int64_t id) const
    {
        for (std::int64_t i = 0; i < system.particles().count(); ++i)
            if (system.particles().id[i] == id) return values[i].xyz();
        return Vec3::Constant(NAN);
    }
};

/// A sphere that lies on the bottom at the overlap at which the linear spring carries its weight; it rolls along x.
struct RollingBall
{
    double radius = 2.6e-3, density = 2600, stiffness = 1e4;
    double gravity = 9.81;
    double slope = 0;  ///< angle of the plane [rad]; downhill is along x

    double mass() const { return density * sphere_volume(radius); }
    double overlap() const { return mass() * gravity * std::cos(slope) / stiffness; }
    double time_step() const { return 3.14159 * std::sqrt(mass() / stiffness) / 50; }

    Case settings(std::string const& rolling, double rolling_friction, double rolling_damping = 0) const
    {
        Case made = linear_case(stiffness, 0.5, density, 0.5);
        made.dem.gravity = {gravity * std::sin(slope), 0, -gravity * std::cos(slope)};
        made.dem.rolling_friction = rolling;
        made.contacts[0].rolling_friction = rolling_friction;
        made.contacts[0].rolling_damping = rolling_damping;
        return made;
    }
    Sphere at_speed(double v) const { return {{0.3, 0.5, radius - overlap()}, radius, {v, 0, 0}, {0, v / radius, 0}}; }
};

}  // namespace gimdem::test

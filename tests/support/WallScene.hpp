// SPDX-License-Identifier: BSD-3-Clause
/// Spheres and walls of a case file, for tests.
#pragma once

#include <utility>
#include <vector>

#include "TestCase.hpp"
#include "engine/DemSystem.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem::test
{

/// Spheres and nothing but walls. Walls move from the first step on.
struct WallScene
{
    WallScene(std::vector<WallItemSettings> const& walls_, std::vector<Sphere> const& spheres, double gravity = 9.81,
              double restitution = 0.9, double friction = 0.3, double young = 1.2e5, exec::Execution execution = serial)
        : WallScene(made(walls_, gravity, restitution, friction, young), spheres, execution)
    {
    }

    WallScene(Case case_settings, std::vector<Sphere> const& spheres, exec::Execution execution = serial)
        : settings(std::move(case_settings)),
          materials(settings),
          particles(particles_of(spheres)),
          walls(settings.wall, largest_radius(particles) + settings.dem.skin * smallest_radius(particles)),
          system(settings, execution, materials, walls, particles)
    {
        system.prepare();
        system.begin_coupling_step(nullptr);
        system.let_walls_move(true);
    }

    static Case made(std::vector<WallItemSettings> const& walls, double gravity, double restitution, double friction,
                     double young)
    {
        Case settings = bead_case(restitution, friction);
        settings.materials[0].young_modulus = young;
        settings.dem.gravity = {0, 0, -gravity};
        settings.wall = walls;
        return settings;
    }

    void run(double time, double dt)
    {
        auto const steps = static_cast<int>(std::lround(time / dt));
        for (int s = 0; s < steps; ++s)
            system.step(dt);
    }

    Vec3 position(int i = 0) const { return system.particles().position[i].xyz(); }
    Vec3 velocity(int i = 0) const { return system.particles().velocity[i].xyz(); }
    Vec3 spin(int i = 0) const { return system.particles().angular_velocity[i].xyz(); }
    Vec3 torque(int i = 0) const { return system.particles().torque[i].xyz(); }
    Vec3 wall_force(int i = 0) const { return system.walls().force_on(i).xyz(); }
    int contacts(int i = 0) const { return static_cast<int>(system.walls().force_on(i).w); }

    Case settings;
    Materials materials;
    ParticleState particles;
    WallGeometry walls;
    DemSystem system;
};

/// Force of a wall on a sphere of the material of bead_case() [N].
inline double hertz_wall(double radius, double overlap, double young = 1.2e5)
{
    return 4.0 / 3.0 * young / (2 * (1 - 0.33 * 0.33)) * std::sqrt(radius) * std::pow(overlap, 1.5);
}

/// Overlap of a sphere that rests on a plane [m].
inline double resting_overlap(double radius, double gravity = 9.81, double young = 1.2e5)
{
    double const weight = 1150 * sphere_volume(radius) * gravity;
    return std::pow(weight / hertz_wall(radius, 1, young), 2.0 / 3.0);
}

}  // namespace gimdem::test

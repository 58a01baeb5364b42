// SPDX-License-Identifier: BSD-3-Clause
/// A few spheres in a box: the fixture of tests that follow single contacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "engine/DemSystem.hpp"

namespace gimdem::test
{

/// The box that the spheres are in. Its patches are left, right, front, back, bottom, top.
struct Box
{
    BoxMesh::Lengths edges;          ///< [m]
    std::vector<std::string> walls;  ///< patches that stop particles
};

/// All six patches.
inline std::vector<std::string> closed()
{
    return {"left", "right", "front", "back", "bottom", "top"};
}

class SphereBox
{
public:
    /// `materials`: number of the material of each sphere; empty: all are of the first.
    SphereBox(Case const& settings, Box const& box, std::vector<Sphere> const& spheres,
              std::vector<int> const& materials = {}, exec::Execution execution = serial)
        : settings_(settings),
          materials_(settings),
          mesh_(mesh_of(box)),
          walls_(mesh_, {}, reach_of(settings, spheres)),
          system_(settings, execution, materials_, walls_, state_of(settings, spheres, materials))
    {
        system_.prepare();
        system_.begin_coupling_step(nullptr);
    }

    void run(std::int64_t steps, double dt)
    {
        for (std::int64_t s = 0; s < steps; ++s)
            system_.step(dt);
    }

    DemSystem& system() { return system_; }
    DemSystem const& system() const { return system_; }
    ParticleState const& particles() const { return system_.particles(); }
    Materials const& materials() const { return materials_; }

    /// Of the sphere that was given as number `id`, whatever its place in memory.
    Vec3 position(std::int64_t id) const { return particles().position[place(id)].xyz(); }
    Vec3 velocity(std::int64_t id) const { return particles().velocity[place(id)].xyz(); }
    Vec3 spin(std::int64_t id) const { return particles().angular_velocity[place(id)].xyz(); }
    Vec3 force(std::int64_t id) const { return particles().force[place(id)].xyz(); }

    /// Makes the sphere keep its angular velocity: an infinite moment of inertia.
    void lock_rotation(std::int64_t id) { system_.particles().angular_velocity[place(id)].w = 0; }

private:
    std::int64_t place(std::int64_t id) const
    {
        std::int64_t i = 0;
        while (particles().id[i] != id)
            ++i;
        return i;
    }

    static coupling::Mesh mesh_of(Box const& box)
    {
        coupling::Mesh mesh = BoxMesh::make({1, 1, 1}, box.edges);
        for (coupling::Patch& patch : mesh.patches)
        {
            bool const stops = std::find(box.walls.begin(), box.walls.end(), patch.name) != box.walls.end();
            patch.kind = stops ? coupling::PatchKind::wall : coupling::PatchKind::open;
        }
        return mesh;
    }

    static double reach_of(Case const& settings, std::vector<Sphere> const& spheres)
    {
        double largest = 0;
        for (Sphere const& s : spheres)
            largest = std::max(largest, s.radius);
        return (1 + settings.dem.skin) * largest;
    }

    static ParticleState state_of(Case const& settings, std::vector<Sphere> const& spheres,
                                  std::vector<int> const& materials)
    {
        ParticleState state = particles_of(spheres, settings.materials[0].density);
        for (std::size_t k = 0; k < materials.size(); ++k)
        {
            auto const i = static_cast<std::int64_t>(k);
            double const heavier =
                settings.materials[static_cast<std::size_t>(materials[k])].density / settings.materials[0].density;
            state.material[i] = materials[k];
            state.velocity[i].w /= heavier;
            state.angular_velocity[i].w /= heavier;
        }
        return state;
    }

    Case settings_;
    Materials materials_;
    PolyMesh mesh_;
    WallGeometry walls_;
    DemSystem system_;
};

}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles and walls.
#pragma once

#include <cstdint>
#include <span>

#include "contact/ContactModel.hpp"
#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem
{

/// Particle-plane pairs that touch or may soon touch, by rising particle, then plane.
struct WallPairs
{
    exec::Buffer<std::int32_t> offsets;  ///< shape=(n_particles + 1,)
    exec::Buffer<std::int32_t> plane;    ///< shape=(n_pairs,)
    exec::Buffer<std::uint8_t> whole;    ///< shape=(n_pairs,): 1 where the plane's rim is out of reach
    exec::Buffer<Quad> displacement;     ///< shape=(n_pairs,), tangential spring [m]
    exec::Buffer<Quad> rolling_spring;   ///< shape=(n_pairs,), torque [N m]; empty where no law has such a spring
};

class WallContacts
{
public:
    WallContacts(exec::Execution execution, Materials const& materials, int wall_material, WallGeometry const& walls)
        : execution_(execution),
          model_(materials),
          material_count_(materials.count()),
          wall_material_(wall_material),
          walls_(walls)
    {
    }

    /// Lists the pairs closer than radius + skin [m]. `order` is the permutation since the last list (empty: none):
    /// springs move along. Throws UserError where one particle is near more planes than a kernel can hold.
    void build(ParticleState const& particles, double skin, std::span<std::int32_t const> order);

    /// Adds the walls' forces and torques; advances the tangential springs by dt [s].
    void add_forces(ParticleState& particles, double dt);

    WallPairs& pairs() { return pairs_; }
    WallPairs const& pairs() const { return pairs_; }
    std::int32_t plane_count() const { return walls_.plane_count(); }

    /// Force of the walls on each particle in the last add_forces [N]; w: number of contacts.
    exec::Buffer<Quad> const& force_on_particles() const { return wall_force_; }

    /// Its sum over all particles [N].
    Vec3 total_force() const { return total_force_.xyz(); }
    /// Puts it back, after a restart.
    void set_total_force(Vec3 const& force) { total_force_.set_xyz(force); }

    static constexpr int most_planes = 16;  ///< near one particle

private:
    void carry_springs(std::span<std::int32_t const> order, exec::Buffer<Quad> const& old_spring,
                       exec::Buffer<Quad>& spring);

    exec::Execution execution_;
    ContactModel model_;
    std::int32_t material_count_;
    std::int32_t wall_material_;
    WallGeometry const& walls_;
    WallPairs pairs_, old_;
    exec::Buffer<std::uint64_t> seen_;  ///< what the first look at the walls found, for the second
    exec::Buffer<Quad> wall_force_;
    Quad total_force_{0, 0, 0, 0};
};

}  // namespace gimdem

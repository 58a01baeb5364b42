// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles and walls.
#pragma once

#include <cstdint>
#include <span>

#include "contact/ContactModel.hpp"
#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "exec/Room.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "walls/WallGeometry.hpp"
#include "walls/WallTouches.hpp"

namespace gimdem
{

/// Particle-plane pairs that touch or may soon touch, by rising particle, then plane.
struct WallPairs
{
    exec::Buffer<std::int32_t> offsets;   ///< shape=(n_particles + 1,)
    exec::Buffer<std::int32_t> plane;     ///< shape=(n_pairs,)
    exec::Buffer<std::int32_t> particle;  ///< shape=(n_pairs,)
    exec::Buffer<std::int32_t> row;       ///< shape=(n_pairs,): of the two materials in the table of laws
    exec::Buffer<std::uint8_t> whole;     ///< shape=(n_pairs,): 1 where the plane's rim is out of reach
    exec::Buffer<std::uint8_t> alone;     ///< shape=(n_pairs,): 1 where no other pair of the particle has a say
    exec::Buffer<Quad> displacement;      ///< shape=(n_pairs,), tangential spring [m]
    exec::Buffer<Quad> rolling_spring;    ///< shape=(n_pairs,), torque [N m]; empty where no law has such a spring
};

struct WallPairsView;

class WallContacts
{
public:
    /// `wall_material`: of walls that name none.
    WallContacts(exec::Execution execution, Materials const& materials, int wall_material, WallGeometry const& walls);

    /// Puts the walls where they are at `time` [s].
    void move_to(double time);
    double time() const { return time_; }              ///< at which the walls stand [s]
    double built_time() const { return built_time_; }  ///< at which they stood when the list was built [s]

    /// True when a wall has moved so far since the list was built that it may miss a contact: more than skin / 2.
    bool is_stale(double skin) const;

    /// Lists the pairs closer than radius + skin [m]. `order` is the permutation since the last list (empty: none):
    /// springs move along. `room`: to work in.
    void build(ParticleState const& particles, double skin, std::span<std::int32_t const> order, exec::Room& room);
    void build(ParticleState const& particles, double skin, std::span<std::int32_t const> order);

    /// Adds the walls' forces and torques; advances the tangential springs by dt [s].
    void add_forces(ParticleState& particles, double dt);

    /// For whoever builds a list elsewhere: it was built now, with all particles and what they reached in a box [m].
    void remember_build(Vec3 const& low, Vec3 const& high);
    exec::Buffer<WallPose> const& poses() const { return poses_; }  ///< of each body, now
    bool some_move() const { return some_wall_moves_; }
    /// Of each body: row of its material in the table of pairs.
    exec::Buffer<std::int32_t> const& first_pairs() const { return first_pair_; }

    WallPairs& pairs() { return pairs_; }
    WallPairs const& pairs() const { return pairs_; }
    std::int32_t plane_count() const { return walls_.plane_count(); }

    /// All that changes from step to step.
    struct Memory
    {
        double time = 0, built_time = 0;
        exec::Buffer<WallPose> poses, built_at;
        Vec3 low = Vec3::Zero(), high = Vec3::Zero();
        WallPairs pairs;
        exec::Buffer<Quad> force;
        Quad total_force{0, 0, 0, 0};
    };
    Memory memory() const { return {time_, built_time_, poses_, built_at_, low_, high_, pairs_, force_, total_force_}; }
    void go_back(Memory const& memory);

    /// Force of the walls on a particle in the last add_forces [N]; w: number of contacts.
    Quad force_on(std::int64_t particle) const;

    /// Its sum over all particles [N].
    Vec3 total_force() const { return total_force_.xyz(); }
    /// Puts it back, after a restart.
    void set_total_force(Vec3 const& force) { total_force_.set_xyz(force); }

private:
    NearbyWalls nearby() const { return {walls_.view(), poses_.view().data}; }
    WallPairsView pairs_view();
    void remember_build(ParticleState const& particles, double skin);

    exec::Execution execution_;
    ContactModel model_;
    WallGeometry const& walls_;
    double time_ = 0, built_time_ = 0;
    bool some_wall_moves_ = false;
    exec::Buffer<WallPose> poses_, built_at_;        ///< of each body, now and when the list was built
    Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();  ///< around all particles and what they reached then [m]
    exec::Buffer<std::int32_t> first_pair_;          ///< of each body: row of its material in the table of pairs
    WallPairs pairs_;
    exec::Buffer<Touch> touches_;  ///< room for the touches of particles with many pairs
    exec::Buffer<Quad> force_;     ///< of each pair [N]; w: 1 where it touches, or where it may hold a spring
    Quad total_force_{0, 0, 0, 0};
};

}  // namespace gimdem

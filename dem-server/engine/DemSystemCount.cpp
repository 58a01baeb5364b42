// SPDX-License-Identifier: BSD-3-Clause
/// How the number of particles changes: what DemSystem holds per particle follows, springs of those that stay included.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/DemSystem.hpp"
#include "search/PairSprings.hpp"

namespace gimdem
{

namespace
{

/// Empty rows for new particles.
void add_rows(exec::Buffer<std::int32_t>& offsets, std::int64_t before, std::int64_t after)
{
    if (offsets.size() != before + 1) return;  // no list so far
    offsets.resize(after + 1);
    for (std::int64_t i = before + 1; i <= after; ++i)
        offsets[i] = offsets[before];
}

/// Keeps the rows `kept` of a list of pairs, and of these the entries that `renumber` gives a number >= 0. `rolling` is
/// empty where no law has such springs.
template <class Renumber>
void keep_rows(exec::Buffer<std::int32_t>& offsets, exec::Buffer<std::int32_t>& partner, exec::Buffer<Quad>& spring,
               exec::Buffer<Quad>& rolling, std::span<std::int32_t const> kept, std::int64_t before, Renumber renumber)
{
    if (offsets.size() != before + 1) return;
    bool const rolls = rolling.size() > 0;
    std::int32_t written = 0;
    std::int64_t row = 0;
    for (std::int32_t const i : kept)
    {
        std::int32_t const begin = offsets[i], end = offsets[i + 1];
        offsets[row++] = written;
        for (std::int32_t k = begin; k < end; ++k)
        {
            std::int32_t const number = renumber(partner[k]);
            if (number < 0) continue;
            partner[written] = number;
            if (rolls) rolling[written] = rolling[k];
            spring[written++] = spring[k];
        }
    }
    offsets[row] = written;
    offsets.resize(row + 1);
    partner.resize(written);
    spring.resize(written);
    if (rolls) rolling.resize(written);
}

/// Keeps the springs of the pairs among those `kept`, and nothing else of the list.
void keep_springs(NeighborList& list, std::span<std::int32_t const> kept, std::span<std::int32_t const> new_number)
{
    SpringsOfPairs springs{tangential_of_pairs(list), rolling_of_pairs(list), {}};
    keep_touching(list, springs);
    keep_rows(list.row_offsets, list.second, springs.tangential, springs.rolling, kept, list.particle_count(),
              [&](std::int32_t j) { return new_number[static_cast<std::size_t>(j)]; });
    put_springs(springs, list);
}

}  // namespace

void DemSystem::insert(ParticleState const& more)
{
    std::int64_t const before = particles_.count(), after = before + more.count();
    if (after == before) return;
    to_change();
    particles_.resize(after);
    bool const has_impulses = impulses_.size() > 0;
    if (has_impulses) impulses_.resize(after);
    for (std::int64_t i = before, k = 0; i < after; ++i, ++k)
    {
        particles_.position[i] = more.position[k];
        particles_.velocity[i] = more.velocity[k];
        particles_.angular_velocity[i] = more.angular_velocity[k];
        particles_.force[i] = particles_.torque[i] = {0, 0, 0, 0};
        particles_.material[i] = more.material[k];
        particles_.id[i] = next_id_++;
        if (has_impulses) impulses_[i] = {};
    }
    add_rows(neighbors_.row_offsets, before, after);
    neighbors_.pools.resize(static_cast<std::size_t>(neighbors_.block_count()));
    add_rows(wall_contacts_.pairs().offsets, before, after);
    rebuild();
}

std::int64_t DemSystem::remove(std::span<std::int32_t const> cause, std::vector<std::string> const& causes)
{
    to_change();
    std::int64_t const before = particles_.count();
    std::vector<std::int32_t> kept, new_number(static_cast<std::size_t>(before), -1);
    for (std::int32_t i = 0; i < before; ++i)
    {
        std::int32_t const why = cause[static_cast<std::size_t>(i)];
        if (why < 0)
        {
            new_number[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(kept.size());
            kept.push_back(i);
            continue;
        }
        Removed& removed = removed_[causes[static_cast<std::size_t>(why)]];
        ++removed.count;
        removed.mass += particles_.mass(i);
    }
    std::int64_t const after = std::ssize(kept);
    if (after == before) return 0;

    if (neighbors_.row_offsets.size() == before + 1) keep_springs(neighbors_, kept, new_number);
    WallPairs& walls = wall_contacts_.pairs();
    keep_rows(walls.offsets, walls.plane, walls.displacement, walls.rolling_spring, kept, before,
              [](std::int32_t plane) { return plane; });
    particles_.permute(execution_, kept);
    particles_.resize(after);
    if (impulses_.size() > 0) permute(execution_, impulses_, kept);
    if (on_permutation_) on_permutation_(kept);
    rebuild();
    return before - after;
}

// The list is a function of the positions it was built at, in their order: sorted as they are, they stay in place. The
// pairs that it finds are then those of the state, in the same order of summation.
void DemSystem::resume(Vec3 const& wall_force)
{
    to_change();
    particle_contacts_.set_one_size(have_one_size(particles_));
    impulses_.resize(0);
    next_id_ = 0;
    for (std::int64_t const id : particles_.id.host())
        next_id_ = std::max(next_id_, id + 1);
    if (particles_.count() == 0) return rebuild();
    exec::Buffer<Quad> now = particles_.position, force = particles_.force, torque = particles_.torque;
    for (std::int64_t i = 0; i < particles_.count(); ++i)
        particles_.position[i].set_xyz(neighbors_.built_at[i].vec());
    auto const order = build_lists();
    permute(execution_, now, order, particles_.position);
    permute(execution_, force, order, particles_.force);
    permute(execution_, torque, order, particles_.torque);
    swap(particles_.position, now);
    swap(particles_.force, force);
    swap(particles_.torque, torque);
    wall_contacts_.set_total_force(wall_force);
    if (on_permutation_) on_permutation_(order);
}

void DemSystem::rebuild()
{
    to_change();
    particle_contacts_.set_one_size(have_one_size(particles_));
    // Stale for any number of particles; none at all have no list to build.
    neighbors_.built_at.resize(0);
    if (particles_.count() == 0)
    {
        neighbors_.second.resize(0);
        neighbors_.row_offsets.resize(0);
        wall_contacts_.pairs().offsets.resize(0);
        loads_.resize(0);
    }
    prepare();
}

std::int64_t lost_particles(DemSystem const& system)
{
    std::int64_t lost = system.next_id() - system.particles().count();
    for (auto const& [cause, removed] : system.removed())
        if (!cause.starts_with(through_wall)) lost -= removed.count;
    return lost;
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Pairs of particles that touch or may soon touch: a Verlet list built from grids of cells, one for each level of
/// sizes, and rebuilt when a particle has moved more than half the skin, theory.md (D.72)-(D.75).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "exec/Room.hpp"
#include "exec/Sort.hpp"
#include "particles/ParticleState.hpp"
#include "search/Domain.hpp"
#include "search/SizeLevels.hpp"
#include "search/SpringPool.hpp"

namespace gimdem
{

/// What a pair across a border does to its second particle.
struct BorderForce
{
    Constant3 force;   ///< [N]
    Constant3 torque;  ///< [N m]
};

/// Pairs whose second particle is in a later block than the first one: each has a slot, numbered along the list.
struct BorderPairs
{
    exec::Buffer<std::int32_t> begin;  ///< shape=(n_blocks + 1,): slots of the pairs that begin in a block
    exec::Groups by_second;            ///< slots of the pairs in which a particle is second
    exec::Buffer<BorderForce> force;   ///< shape=(n_slots,): of the last sum, zero where the pair does not touch
};

/// What kernels see of the list.
struct NeighborListView
{
    std::uint16_t const* first_in_block;
    std::int32_t const* second;
    std::int32_t const* row_offsets;
    std::int32_t* border_begin;
    std::int32_t const* border_offsets;
    std::int32_t const* border_slots;
    SpringPool::Slot* spring;
    SpringPool* pools;
    BorderForce* border_force;
    std::int64_t particle_count;
};

/// The pairs, each once, in rising (first, second). A pair has springs while it touches, in the pool of the block of
/// its first particle, theory.md (D.76).
struct NeighborList
{
    static constexpr std::int64_t block = 1024;  ///< particles that are worked on together

    exec::Buffer<std::uint16_t> first_in_block;  ///< shape=(n_pairs,), particle i of the pair, less that of its block
    exec::Buffer<std::int32_t> second;           ///< shape=(n_pairs,), particle j > i
    exec::Buffer<std::int32_t> row_offsets;      ///< shape=(n_particles + 1,): pairs of i are [row_offsets i, i + 1)
    BorderPairs border;
    exec::Buffer<SpringPool::Slot> spring;  ///< shape=(n_pairs,), slot of its springs; none where it does not touch
    std::vector<SpringPool> pools;          ///< shape=(n_blocks,)
    exec::Buffer<Constant3> built_at;       ///< shape=(n_particles,), positions when the list was built [m]

    bool carries_rolling = false;  ///< whether pairs have rolling springs as well

    std::int64_t pair_count() const { return second.size(); }
    std::int64_t particle_count() const { return row_offsets.size() > 0 ? row_offsets.size() - 1 : 0; }
    std::int64_t block_count() const { return (particle_count() + block - 1) / block; }
    NeighborListView view()
    {
        return {first_in_block.view().data,
                second.view().data,
                row_offsets.view().data,
                border.begin.view().data,
                border.by_second.offsets.view().data,
                border.by_second.members.view().data,
                spring.view().data,
                pools.data(),
                border.force.view().data,
                particle_count()};
    }
};

/// Builds the list of pairs closer than the sum of radii + skin.
class NeighborSearch
{
public:
    NeighborSearch(exec::Execution execution, double skin, Domain const& domain = {})
        : execution_(execution), skin_(skin), domain_(domain)
    {
    }

    double skin() const { return skin_; }  ///< [m]

    /// True when the list may miss a contact: a particle moved more than skin / 2 since it was built.
    bool is_stale(ParticleState const& particles, NeighborList const& list) const;

    /// Moves the particles into the periodic box, sorts them by level and cell, lists the pairs and carries the springs
    /// along. Forces and torques, which are to be computed anew, lend their memory and mean nothing afterwards. Returns
    /// the permutation: the particle now at i was at order[i]. Throws UserError for a position that is not finite and
    /// for a periodic box that is too small.
    std::span<std::int32_t const> build(ParticleState& particles, NeighborList& list);

    /// How many pairs build() has looked at to find those it listed: the cost of a search, whatever the machine.
    std::int64_t count_candidates(ParticleState const& particles) const;

private:
    void sort_into_cells(ParticleState& particles);
    void list_border(NeighborList& list);
    void list_pairs(ParticleState const& particles, NeighborList& list);
    template <class Work>
    void with_candidates(ParticleState const& particles, Work&& work) const;
    template <class Candidates, class Near>
    void fill(std::int64_t n, Candidates const& candidates, Near const& near, NeighborList& list);

    exec::Execution execution_;
    double skin_;
    Domain domain_;
    SizeLevels levels_;
    exec::Buffer<std::int32_t> cell_of_;  ///< while a list is built; its memory is the border's afterwards
    exec::Groups by_cell_;                ///< the same of its offsets; its members are the permutation
    exec::Room room_;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Pairs of particles that touch or may soon touch: a Verlet list built from grids of cells, one for each level of
/// sizes, and rebuilt when a particle has moved more than half the skin, theory.md (D.72)-(D.75).
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "exec/Sort.hpp"
#include "particles/ParticleState.hpp"
#include "search/Domain.hpp"
#include "search/SizeLevels.hpp"

namespace gimdem
{

/// The pairs, each once, in rising (first, second); and the same by second member, for sums without atomics.
/// Pairs whose second particle is in a later block than the first one: each has a slot, numbered along the list.
struct BorderPairs
{
    exec::Buffer<std::int32_t> slot;   ///< shape=(n_pairs,), -1 for a pair within a block
    exec::Buffer<std::int32_t> pairs;  ///< shape=(n_slots,)
    exec::Groups by_second;            ///< border pairs in which a particle is second
};

/// What kernels see of the list.
struct NeighborListView
{
    std::int32_t const* first;
    std::int32_t const* second;
    std::int32_t const* row_offsets;
    std::int32_t const* border_slot;
    std::int32_t const* border_offsets;
    std::int32_t const* border_pairs;
    Quad* displacement;
    Quad* rolling_spring;  ///< null where no law has such a spring
    std::uint8_t* touches;
};

struct NeighborList
{
    static constexpr std::int64_t block = 1024;  ///< particles that are worked on together

    exec::Buffer<std::int32_t> first;        ///< shape=(n_pairs,), particle i of the pair
    exec::Buffer<std::int32_t> second;       ///< shape=(n_pairs,), particle j > i
    exec::Buffer<std::int32_t> row_offsets;  ///< shape=(n_particles + 1,): pairs of i are [row_offsets i, i + 1)
    BorderPairs border;
    exec::Buffer<Quad> displacement;     ///< shape=(n_pairs,), tangential spring of the pair [m]
    exec::Buffer<Quad> rolling_spring;   ///< shape=(n_pairs,), torque on the first [N m]; see carries_rolling
    exec::Buffer<std::uint8_t> touches;  ///< shape=(n_pairs,), 1 where the pair touched when it was last looked at
    exec::Buffer<Quad> spare;            ///< means nothing between calls: room for whoever works on the list
    exec::Buffer<Quad> built_at;         ///< shape=(n_particles,), positions when the list was built [m]

    bool carries_rolling = false;  ///< whether rolling_spring is kept; otherwise it is empty

    std::int64_t pair_count() const { return first.size(); }
    std::int64_t block_count() const { return (row_offsets.size() + block - 2) / block; }
    NeighborListView view()
    {
        return {first.view().data,
                second.view().data,
                row_offsets.view().data,
                border.slot.view().data,
                border.by_second.offsets.view().data,
                border.by_second.members.view().data,
                displacement.view().data,
                rolling_spring.view().data,
                touches.view().data};
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

    /// Moves the particles into the periodic box, sorts them by level and cell, lists the pairs and carries the
    /// tangential springs along. Returns the permutation: the particle now at i was at order[i]. Throws UserError for a
    /// position that is not finite and for a periodic box that is too small.
    std::span<std::int32_t const> build(ParticleState& particles, NeighborList& list);

    /// How many pairs build() has looked at to find those it listed: the cost of a search, whatever the machine.
    std::int64_t count_candidates(ParticleState const& particles) const;

private:
    void sort_into_cells(ParticleState& particles);
    void list_border(NeighborList& list);
    void list_pairs(ParticleState const& particles, NeighborList& list);
    void carry_springs(exec::Buffer<Quad> const& old_spring, NeighborList const& list, exec::Buffer<Quad>& spring);
    template <class Work>
    void with_candidates(ParticleState const& particles, Work&& work) const;
    template <class Candidates, class Near>
    void fill(std::int64_t n, Candidates const& candidates, Near const& near, NeighborList& list);

    exec::Execution execution_;
    double skin_;
    Domain domain_;
    SizeLevels levels_;
    exec::Buffer<std::int32_t> cell_of_;
    exec::Groups by_cell_;
    NeighborList old_;
    exec::Buffer<std::int32_t> border_seconds_;
};

}  // namespace gimdem

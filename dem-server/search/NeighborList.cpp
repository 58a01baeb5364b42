// SPDX-License-Identifier: BSD-3-Clause
#include "search/NeighborList.hpp"

#include <limits>
#include <type_traits>
#include <utility>

#include "exec/Reduce.hpp"
#include "search/CandidateVisitor.hpp"
#include "search/KeptSprings.hpp"
#include "search/PairListKernels.hpp"
#include "search/PairSprings.hpp"

namespace gimdem
{

namespace
{

/// First particle of a pair, as the list holds it.
struct FirstInBlock
{
    std::uint16_t* first;

    void set(std::int32_t pair, std::int64_t i) const
    {
        first[pair] = static_cast<std::uint16_t>(i % NeighborList::block);
    }
};

/// Counts the pairs of one block that cross its border, then lists the second particles of them.
struct BorderLister
{
    NeighborListView list;
    std::int32_t* second_of_slot;  ///< null: count

    void operator()(std::int64_t b) const
    {
        auto const [begin, end] = block_of(list, b);
        std::int32_t count = 0;
        for (std::int32_t k = list.row_offsets[begin]; k < list.row_offsets[end]; ++k)
        {
            if (list.second[k] < end) continue;
            if (second_of_slot != nullptr) second_of_slot[list.border_begin[b] + count] = list.second[k];
            ++count;
        }
        if (second_of_slot == nullptr) list.border_begin[b] = count;
    }
};

}  // namespace

bool NeighborSearch::is_stale(ParticleState const& particles, NeighborList const& list) const
{
    if (list.built_at.size() != particles.count()) return true;
    Quad const* const now = particles.position.view().data;
    Constant3 const* const then = list.built_at.view().data;
    double const moved = exec::maximum(
        execution_, particles.count(), 0.0,
        [=](std::int64_t i)
        {
            double const distance = (now[i].xyz() - then[i].vec()).squaredNorm();
            return distance >= 0 ? distance : std::numeric_limits<double>::infinity();  // a NaN must not hide
        });
    return 4 * moved > skin_ * skin_;
}

std::span<std::int32_t const> NeighborSearch::build(ParticleState& particles, NeighborList& list)
{
    bool const has_springs = list.row_offsets.size() == particles.count() + 1;
    // The cells take the place of the border, which is listed when they are no longer needed.
    swap(cell_of_, list.border.by_second.members);
    swap(by_cell_.offsets, list.border.by_second.offsets);
    sort_into_cells(particles);
    room_.clear();
    room_.lend(particles.force);
    room_.lend(particles.torque);
    room_.lend(list.border.force);
    KeptSprings kept;
    if (has_springs) kept.keep(execution_, list, room_);
    list_pairs(particles, list);
    if (has_springs)
        kept.give(execution_, by_cell_.members.host(), list);
    else
    {
        list.spring.fill(SpringPool::none);
        reset_pools(list, std::vector<std::int32_t>(static_cast<std::size_t>(list.block_count())));
    }
    swap(cell_of_, list.border.by_second.members);
    swap(by_cell_.offsets, list.border.by_second.offsets);
    list_border(list);
    list.built_at.resize(particles.count());
    exec::for_each(execution_, particles.count(),
                   [to = list.built_at.view(), from = std::as_const(particles).position.view()](std::int64_t i) {
                       to[i] = {from[i].x, from[i].y, from[i].z};
                   });
    return by_cell_.members.host();
}

std::int64_t NeighborSearch::count_candidates(ParticleState const& particles) const
{
    // The cells of the last search have given their memory away: they are found again.
    NeighborSearch again(execution_, skin_, domain_);
    again.levels_ = levels_;
    again.cell_of_.resize(particles.count());
    for (std::int64_t i = 0; i < particles.count(); ++i)
        again.cell_of_[i] = levels_.cell_of(particles.position[i]);
    exec::group_by_key(execution_, again.cell_of_.host(), levels_.cell_count, again.by_cell_);
    std::int64_t count = 0;
    again.with_candidates(particles,
                          [&](auto const& candidates, auto const&)
                          {
                              count = exec::reduce(
                                  execution_, particles.count(), std::int64_t{0},
                                  [=](std::int64_t i) { return candidates.count(i); },
                                  [](std::int64_t a, std::int64_t b) { return a + b; });
                          });
    return count;
}

void NeighborSearch::sort_into_cells(ParticleState& particles)
{
    Quad* const position = particles.position.view().data;
    if (domain_.is_periodic())
        exec::for_each(execution_, particles.count(),
                       [=, domain = domain_](std::int64_t i) { position[i].set_xyz(domain.wrap(position[i].xyz())); });
    Extent const extent = Extent::of(execution_, particles);
    domain_.require_room(2 * extent.largest_radius + skin_);
    levels_ = SizeLevels::of(execution_, particles, extent, skin_, domain_);

    cell_of_.resize(particles.count());
    std::int32_t* const cell_of = cell_of_.view().data;
    exec::for_each(execution_, particles.count(),
                   [=, levels = levels_](std::int64_t i) { cell_of[i] = levels.cell_of(position[i]); });
    exec::group_by_key(execution_, cell_of_.host(), levels_.cell_count, by_cell_);
    particles.permute(execution_, by_cell_.members.host());
    permute(execution_, cell_of_, by_cell_.members.host(), particles.torque);
}

/// Calls work(candidates, near) with the visitor and the test that fit the domain.
template <class Work>
void NeighborSearch::with_candidates(ParticleState const& particles, Work&& work) const
{
    in_space_of(domain_,
                [&]<class Space>(Space space)
                {
                    constexpr bool periodic = !std::is_same_v<Space, OpenSpace>;
                    Quad const* const position = particles.position.view().data;
                    work(CandidateVisitor<periodic>{levels_, domain_.period, skin_, position,
                                                    by_cell_.offsets.view().data, cell_of_.view().data},
                         Nearness<Space>{position, skin_, space});
                });
}

void NeighborSearch::list_pairs(ParticleState const& particles, NeighborList& list)
{
    with_candidates(particles,
                    [&](auto const& candidates, auto const& near) { fill(particles.count(), candidates, near, list); });
}

template <class Candidates, class Near>
void NeighborSearch::fill(std::int64_t n, Candidates const& candidates, Near const& near, NeighborList& list)
{
    list.row_offsets.resize(n + 1);
    exec::for_each(execution_, n, PairCounter<Candidates, Near>{candidates, near, list.row_offsets.view().data});
    std::int64_t const pairs = exec::exclusive_scan(execution_, list.row_offsets.host());

    list.first_in_block.resize(pairs);
    list.second.resize(pairs);
    list.spring.resize(pairs);
    exec::for_each(execution_, n,
                   PairFiller<Candidates, Near, FirstInBlock>{candidates,
                                                              near,
                                                              list.row_offsets.view().data,
                                                              {list.first_in_block.view().data},
                                                              list.second.view().data});
}

void NeighborSearch::list_border(NeighborList& list)
{
    BorderPairs& border = list.border;
    std::int64_t const blocks = list.block_count();
    border.begin.resize(blocks + 1);
    BorderLister lister{list.view(), nullptr};
    exec::for_each(execution_, blocks, lister);
    std::int64_t const slots = exec::exclusive_scan(border.begin.host());

    lister.second_of_slot = room_.take<std::int32_t>(slots);
    exec::for_each(execution_, blocks, lister);
    exec::group_by_key(execution_, {lister.second_of_slot, static_cast<std::size_t>(slots)}, list.particle_count(),
                       border.by_second);
    // Last: until here it was lent as room.
    border.force.resize(slots);
    border.force.fill({{0, 0, 0}, {0, 0, 0}});
}

}  // namespace gimdem

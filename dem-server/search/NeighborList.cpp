// SPDX-License-Identifier: BSD-3-Clause
#include "search/NeighborList.hpp"

#include <limits>
#include <type_traits>

#include "exec/Reduce.hpp"
#include "search/CandidateVisitor.hpp"
#include "search/PairListKernels.hpp"

namespace gimdem
{

bool NeighborSearch::is_stale(ParticleState const& particles, NeighborList const& list) const
{
    if (list.built_at.size() != particles.count()) return true;
    Quad const* const now = particles.position.view().data;
    Quad const* const then = list.built_at.view().data;
    double const moved = exec::maximum(
        execution_, particles.count(), 0.0,
        [=](std::int64_t i)
        {
            double const distance = (now[i].xyz() - then[i].xyz()).squaredNorm();
            return distance >= 0 ? distance : std::numeric_limits<double>::infinity();  // a NaN must not hide
        });
    return 4 * moved > skin_ * skin_;
}

std::span<std::int32_t const> NeighborSearch::build(ParticleState& particles, NeighborList& list)
{
    bool const has_springs = list.row_offsets.size() == particles.count() + 1;
    sort_into_cells(particles);
    swap(old_.second, list.second);
    swap(old_.row_offsets, list.row_offsets);
    swap(list.spare, list.displacement);
    swap(old_.rolling_spring, list.rolling_spring);
    list_pairs(particles, list);
    if (has_springs)
        carry_springs(list.spare, list, list.displacement);
    else
        list.displacement.fill({0, 0, 0, 0});
    if (has_springs && list.carries_rolling)
        carry_springs(old_.rolling_spring, list, list.rolling_spring);
    else
        list.rolling_spring.fill({0, 0, 0, 0});
    list.built_at = particles.position;
    return by_cell_.members.host();
}

std::int64_t NeighborSearch::count_candidates(ParticleState const& particles) const
{
    std::int64_t count = 0;
    with_candidates(particles,
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
    permute(execution_, cell_of_, by_cell_.members.host());
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

    list.first.resize(pairs);
    list.second.resize(pairs);
    list.displacement.resize(pairs);
    list.rolling_spring.resize(list.carries_rolling ? pairs : 0);
    list.touches.resize(pairs);
    list.touches.fill(1);
    exec::for_each(execution_, n,
                   PairFiller<Candidates, Near>{candidates, near, list.row_offsets.view().data, list.first.view().data,
                                                list.second.view().data});
    list_border(list);
}

void NeighborSearch::list_border(NeighborList& list)
{
    BorderPairs& border = list.border;
    auto const pairs = static_cast<std::int32_t>(list.pair_count());
    border.slot.resize(pairs);
    std::int32_t slots = 0;
    for (std::int32_t k = 0; k < pairs; ++k)
    {
        bool const crosses = list.first[k] / NeighborList::block != list.second[k] / NeighborList::block;
        border.slot[k] = crosses ? slots : -1;
        slots += crosses;
    }
    border.pairs.resize(slots);
    border_seconds_.resize(slots);
    for (std::int32_t k = 0; k < pairs; ++k)
        if (std::int32_t const slot = border.slot[k]; slot >= 0)
        {
            border.pairs[slot] = k;
            border_seconds_[slot] = list.second[k];
        }
    exec::group_by_key(execution_, border_seconds_.host(), list.row_offsets.size() - 1, border.by_second);
    for (std::int32_t& member : border.by_second.members.host())
        member = border.pairs[member];
}

void NeighborSearch::carry_springs(exec::Buffer<Quad> const& old_spring, NeighborList const& list,
                                   exec::Buffer<Quad>& spring)
{
    exec::for_each(execution_, list.pair_count(),
                   SpringCarrier{list.first.view().data, list.second.view().data, by_cell_.members.view().data,
                                 old_.row_offsets.view().data, old_.second.view().data, old_spring.view().data,
                                 spring.view().data});
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "search/NeighborList.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/Error.hpp"
#include "exec/Reduce.hpp"

namespace gimdem
{

namespace
{

/// Visits, in rising order, every j > i in the cell of i and the cells around it. Particles are sorted by cell and
/// cells along x are consecutive, so each row of three cells is one range of particles.
struct CandidateVisitor
{
    CellGrid grid;
    std::int32_t const* cell_start;
    std::int32_t const* cell_of;

    template <class Visit>
    GIMDEM_HD void operator()(std::int64_t i, Visit&& visit) const
    {
        std::int32_t const cell = cell_of[i];
        std::int32_t const x = cell % grid.nx;
        std::int32_t const y = cell / grid.nx % grid.ny;
        std::int32_t const z = cell / grid.nx / grid.ny;
        std::int32_t const x0 = x > 0 ? x - 1 : 0;
        std::int32_t const x1 = x + 1 < grid.nx ? x + 1 : x;
        for (std::int32_t dz = 0; dz <= 1; ++dz)
            for (std::int32_t dy = dz == 0 ? 0 : -1; dy <= 1; ++dy)
            {
                if (z + dz >= grid.nz || y + dy < 0 || y + dy >= grid.ny) continue;
                std::int32_t const row = ((z + dz) * grid.ny + y + dy) * grid.nx;
                std::int64_t const begin = dz == 0 && dy == 0 ? i + 1 : cell_start[row + x0];
                for (std::int64_t j = begin; j < cell_start[row + x1 + 1]; ++j)
                    visit(j);
            }
    }
};

/// True for particles closer than the sum of their radii + skin.
struct Nearness
{
    Quad const* position;
    double skin;

    GIMDEM_HD bool operator()(std::int64_t i, std::int64_t j) const
    {
        double const reach = position[i].w + position[j].w + skin;
        return (position[i].xyz() - position[j].xyz()).squaredNorm() < reach * reach;
    }
};

/// Number of pairs of each particle as the first member.
struct PairCounter
{
    CandidateVisitor visit_candidates;
    Nearness near;
    std::int32_t* counts;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int32_t count = 0;
        visit_candidates(i, [&](std::int64_t j) { count += near(i, j); });
        counts[i] = count;
    }
};

struct PairFiller
{
    CandidateVisitor visit_candidates;
    Nearness near;
    std::int32_t const* offsets;
    std::int32_t* first;
    std::int32_t* second;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int32_t k = offsets[i];
        visit_candidates(i,
                         [&](std::int64_t j)
                         {
                             if (!near(i, j)) return;
                             first[k] = static_cast<std::int32_t>(i);
                             second[k++] = static_cast<std::int32_t>(j);
                         });
    }
};

/// Finds the spring of a pair in the old list, whose particles had other numbers; a swapped pair changes its sign.
struct SpringCarrier
{
    std::int32_t const* first;
    std::int32_t const* second;
    std::int32_t const* old_place;
    std::int32_t const* old_offsets;
    std::int32_t const* old_second;
    Quad const* old_displacement;
    Quad* displacement;

    GIMDEM_HD void operator()(std::int64_t k) const
    {
        std::int32_t const i = old_place[first[k]];
        std::int32_t const j = old_place[second[k]];
        std::int32_t const low = i < j ? i : j;
        std::int32_t const high = i < j ? j : i;
        displacement[k] = {0, 0, 0, 0};
        for (std::int32_t old = old_offsets[low]; old < old_offsets[low + 1]; ++old)
            if (old_second[old] == high)
            {
                Vec3 const spring = old_displacement[old].xyz();
                displacement[k] = Quad::of(i == low ? spring : Vec3(-spring), 0);
            }
    }
};

}  // namespace

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
    swap(old_.displacement, list.displacement);
    swap(old_.rolling_spring, list.rolling_spring);
    list_pairs(particles, list);
    if (has_springs)
        carry_springs(old_.displacement, list, list.displacement);
    else
        list.displacement.fill({0, 0, 0, 0});
    if (has_springs && list.carries_rolling)
        carry_springs(old_.rolling_spring, list, list.rolling_spring);
    else
        list.rolling_spring.fill({0, 0, 0, 0});
    list.built_at = particles.position;
    return by_cell_.members.host();
}

void NeighborSearch::sort_into_cells(ParticleState& particles)
{
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    double largest = 0;
    for (std::int64_t i = 0; i < particles.count(); ++i)
    {
        Vec3 const x = particles.position[i].xyz();
        if (!x.allFinite())
            throw UserError(
                fmt::format("particle {} has no finite position (the motion diverged); reduce [dem] "
                            "time_step or check the materials",
                            particles.id[i]));
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
        largest = std::max(largest, particles.position[i].w);
    }
    if (particles.count() == 0) low = high = Vec3::Zero();
    grid_ = CellGrid::over(low, high, 2 * largest + skin_, 8 * particles.count() + 1000);

    cell_of_.resize(particles.count());
    Quad const* const position = particles.position.view().data;
    std::int32_t* const cell_of = cell_of_.view().data;
    exec::for_each(execution_, particles.count(),
                   [=, grid = grid_](std::int64_t i) { cell_of[i] = grid.cell_of(position[i].xyz()); });
    exec::group_by_key(cell_of_.host(), grid_.count(), by_cell_);
    particles.permute(by_cell_.members.host());
    permute(cell_of_, by_cell_.members.host());
}

void NeighborSearch::list_pairs(ParticleState const& particles, NeighborList& list)
{
    std::int64_t const n = particles.count();
    CandidateVisitor const visit{grid_, by_cell_.offsets.view().data, cell_of_.view().data};
    Nearness const near{particles.position.view().data, skin_};

    list.row_offsets.resize(n + 1);
    exec::for_each(execution_, n, PairCounter{visit, near, list.row_offsets.view().data});
    std::int64_t const pairs = exec::exclusive_scan(list.row_offsets.host());

    list.first.resize(pairs);
    list.second.resize(pairs);
    list.displacement.resize(pairs);
    list.rolling_spring.resize(list.carries_rolling ? pairs : 0);
    list.touches.resize(pairs);
    list.touches.fill(1);
    exec::for_each(
        execution_, n,
        PairFiller{visit, near, list.row_offsets.view().data, list.first.view().data, list.second.view().data});
    list_border(list);
}

void NeighborSearch::list_border(NeighborList& list)
{
    BorderPairs& border = list.border;
    border.slot.resize(list.pair_count());
    border.pairs.resize(list.pair_count());
    border_seconds_.resize(list.pair_count());
    std::int32_t slots = 0;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(list.pair_count()); ++k)
    {
        bool const crosses = list.first[k] / NeighborList::block != list.second[k] / NeighborList::block;
        border.slot[k] = crosses ? slots : -1;
        border.pairs[slots] = k;
        border_seconds_[slots] = list.second[k];
        slots += crosses;
    }
    border.pairs.resize(slots);
    border_seconds_.resize(slots);
    exec::group_by_key(border_seconds_.host(), list.row_offsets.size() - 1, border.by_second);
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

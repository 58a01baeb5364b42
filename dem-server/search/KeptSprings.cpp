// SPDX-License-Identifier: BSD-3-Clause
#include "search/KeptSprings.hpp"

#include "exec/ForEach.hpp"
#include "exec/Sort.hpp"
#include "search/PairSprings.hpp"

namespace gimdem
{

namespace
{

/// Number of touching pairs of each particle as the first member.
struct TouchCounter
{
    std::int32_t const* row_offsets;
    SpringPool::Slot const* slot;
    std::int32_t* counts;

    void operator()(std::int64_t i) const
    {
        std::int32_t count = 0;
        for (std::int32_t k = row_offsets[i]; k < row_offsets[i + 1]; ++k)
            count += slot[k] != SpringPool::none;
        counts[i] = count;
    }
};

/// Copies the springs of one block.
struct SpringKeeper
{
    NeighborListView list;
    std::int32_t const* offsets;
    std::int32_t* partner;
    Spring* const* tangential;
    Spring* const* rolling;

    void operator()(std::int64_t b) const
    {
        auto const [begin, end] = block_of(list, b);
        SpringPool const& pool = list.pools[b];
        std::int32_t const first = offsets[begin];
        std::int32_t member = first;
        for (std::int32_t k = list.row_offsets[begin]; k < list.row_offsets[end]; ++k)
        {
            SpringPool::Slot const slot = list.spring[k];
            if (slot == SpringPool::none) continue;
            partner[member] = list.second[k];
            tangential[b][member - first] = pool.tangential()[slot];
            if (rolling != nullptr) rolling[b][member - first] = pool.rolling()[slot];
            ++member;
        }
    }
};

/// Numbers the pairs of one block that had springs: these numbers are their slots.
struct SlotGiver
{
    NeighborListView list;
    KeptSpringsView kept;
    std::int32_t* counts;

    void operator()(std::int64_t b) const
    {
        auto const [begin, end] = block_of(list, b);
        std::int32_t count = 0;
        for (std::int64_t i = begin; i < end; ++i)
            for (std::int32_t k = list.row_offsets[i]; k < list.row_offsets[i + 1]; ++k)
            {
                bool const known = kept.find(static_cast<std::int32_t>(i), list.second[k]).member >= 0;
                list.spring[k] = known ? static_cast<SpringPool::Slot>(count) : SpringPool::none;
                count += known;
            }
        counts[b] = count;
    }
};

/// Fills the slots of one block.
struct SpringGiver
{
    NeighborListView list;
    KeptSpringsView kept;

    void operator()(std::int64_t b) const
    {
        auto const [begin, end] = block_of(list, b);
        SpringPool& pool = list.pools[b];
        for (std::int64_t i = begin; i < end; ++i)
            for (std::int32_t k = list.row_offsets[i]; k < list.row_offsets[i + 1]; ++k)
            {
                SpringPool::Slot const slot = list.spring[k];
                if (slot == SpringPool::none) continue;
                KeptSpringsView::Place const place = kept.find(static_cast<std::int32_t>(i), list.second[k]);
                pool.tangential()[slot] = kept.at(kept.tangential, place);
                if (kept.rolling != nullptr) pool.rolling()[slot] = kept.at(kept.rolling, place);
            }
    }
};

}  // namespace

void KeptSprings::keep(exec::Execution const& execution, NeighborList& list, exec::Room& room)
{
    std::int64_t const n = list.particle_count(), blocks = list.block_count();
    NeighborListView const view = list.view();
    auto* const offsets = room.take<std::int32_t>(n + 1);
    exec::for_each(execution, n, TouchCounter{view.row_offsets, view.spring, offsets});
    std::int64_t const count = exec::exclusive_scan(execution, {offsets, static_cast<std::size_t>(n + 1)});
    auto* const partner = room.take<std::int32_t>(count);
    tangential_.resize(static_cast<std::size_t>(blocks));
    rolling_.resize(list.carries_rolling ? tangential_.size() : 0);
    for (std::size_t b = 0; b < tangential_.size(); ++b)
    {
        auto const [begin, end] = block_of(view, static_cast<std::int64_t>(b));
        tangential_[b] = room.take<Spring>(offsets[end] - offsets[begin]);
        if (list.carries_rolling) rolling_[b] = room.take<Spring>(offsets[end] - offsets[begin]);
    }
    offsets_ = offsets;
    partner_ = partner;
    exec::for_each(
        execution, blocks,
        SpringKeeper{view, offsets, partner, tangential_.data(), rolling_.empty() ? nullptr : rolling_.data()});
}

void KeptSprings::give(exec::Execution const& execution, std::span<std::int32_t const> new_to_old,
                       NeighborList& list) const
{
    KeptSpringsView const kept{offsets_, partner_, tangential_.data(), rolling_.empty() ? nullptr : rolling_.data(),
                               new_to_old.data()};
    std::int64_t const blocks = list.block_count();
    std::vector<std::int32_t> counts(static_cast<std::size_t>(blocks));
    exec::for_each(execution, blocks, SlotGiver{list.view(), kept, counts.data()});
    reset_pools(list, counts);
    exec::for_each(execution, blocks, SpringGiver{list.view(), kept});
}

}  // namespace gimdem

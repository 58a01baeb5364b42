// SPDX-License-Identifier: BSD-3-Clause
#include "search/PairSprings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/Error.hpp"

namespace gimdem
{

namespace
{

[[noreturn]] void fail_too_many(std::int64_t block)
{
    std::int64_t const first = block * NeighborList::block;
    throw UserError(fmt::format(
        "particles {} to {} in memory have {} contacts or more, or memory has run out (there is no room for "
        "the springs of the next contact); reduce [dem] time_step if particles overlap deeply, or use fewer "
        "particles",
        first, first + NeighborList::block - 1, SpringPool::none));
}

/// Calls visit(k, i) for all pairs.
template <class Visit>
void for_each_pair(NeighborList const& list, Visit&& visit)
{
    for (std::int64_t i = 0; i < list.particle_count(); ++i)
        for (std::int32_t k = list.row_offsets[i]; k < list.row_offsets[i + 1]; ++k)
            visit(k, i);
}

/// of_pool: the springs that a pool holds of the kind that is wanted.
template <class OfPool>
exec::Buffer<Quad> springs_of_pairs(NeighborList const& list, OfPool of_pool)
{
    exec::Buffer<Quad> springs(list.pair_count());
    springs.fill({0, 0, 0, 0});
    for_each_pair(list,
                  [&](std::int32_t k, std::int64_t i)
                  {
                      if (list.spring[k] == SpringPool::none) return;
                      auto const& pool = list.pools[static_cast<std::size_t>(i / NeighborList::block)];
                      springs[k] = Quad::of(of_pool(pool)[list.spring[k]].vec(), 0);
                  });
    return springs;
}

}  // namespace

void reset_pools(NeighborList& list, std::span<std::int32_t const> counts)
{
    list.pools.resize(counts.size());
    for (std::size_t b = 0; b < counts.size(); ++b)
    {
        if (counts[b] >= SpringPool::none) fail_too_many(static_cast<std::int64_t>(b));
        // Anew, with room for some contacts to come: what many contacts once needed is not held for ever.
        SpringPool pool;
        pool.reset(counts[b] + counts[b] / 32 + 8, list.carries_rolling);
        pool.reset(counts[b], list.carries_rolling);
        list.pools[b] = std::move(pool);
    }
}

void require_springs(NeighborList const& list)
{
    for (std::size_t b = 0; b < list.pools.size(); ++b)
        if (list.pools[b].is_short()) fail_too_many(static_cast<std::int64_t>(b));
}

exec::Buffer<std::int32_t> first_of_pairs(NeighborList const& list)
{
    exec::Buffer<std::int32_t> first(list.pair_count());
    for_each_pair(list, [&](std::int32_t k, std::int64_t i) { first[k] = static_cast<std::int32_t>(i); });
    return first;
}

exec::Buffer<std::uint8_t> touches_of_pairs(NeighborList const& list)
{
    exec::Buffer<std::uint8_t> touches(list.pair_count());
    for_each_pair(list, [&](std::int32_t k, std::int64_t) { touches[k] = list.spring[k] != SpringPool::none; });
    return touches;
}

exec::Buffer<Quad> tangential_of_pairs(NeighborList const& list)
{
    return springs_of_pairs(list, [](SpringPool const& pool) { return pool.tangential(); });
}

exec::Buffer<Quad> rolling_of_pairs(NeighborList const& list)
{
    if (!list.carries_rolling) return {};
    return springs_of_pairs(list, [](SpringPool const& pool) { return pool.rolling(); });
}

void keep_touching(NeighborList& list, SpringsOfPairs& springs)
{
    bool const rolls = springs.rolling.size() > 0;
    std::int32_t written = 0, end = 0;
    for (std::int64_t i = 0; i < list.particle_count(); ++i)
    {
        std::int32_t const begin = end;
        end = list.row_offsets[i + 1];
        list.row_offsets[i] = written;
        for (std::int32_t k = begin; k < end; ++k)
        {
            if (list.spring[k] == SpringPool::none) continue;
            list.second[written] = list.second[k];
            if (rolls) springs.rolling[written] = springs.rolling[k];
            springs.tangential[written++] = springs.tangential[k];
        }
    }
    if (list.row_offsets.size() > 0) list.row_offsets[list.particle_count()] = written;
    list.second.resize(written);
    springs.tangential.resize(written);
    if (rolls) springs.rolling.resize(written);
}

void put_springs(SpringsOfPairs const& springs, NeighborList& list)
{
    list.first_in_block.resize(list.pair_count());
    list.spring.resize(list.pair_count());
    std::vector<std::int32_t> counts(static_cast<std::size_t>(list.block_count()));
    for_each_pair(list,
                  [&](std::int32_t k, std::int64_t i)
                  {
                      list.first_in_block[k] = static_cast<std::uint16_t>(i % NeighborList::block);
                      bool const touches = springs.touches.size() == 0 || springs.touches[k] != 0;
                      std::int32_t& count = counts[static_cast<std::size_t>(i / NeighborList::block)];
                      list.spring[k] = touches ? static_cast<SpringPool::Slot>(count) : SpringPool::none;
                      count += touches;
                  });
    reset_pools(list, counts);
    for_each_pair(list,
                  [&](std::int32_t k, std::int64_t i)
                  {
                      SpringPool::Slot const slot = list.spring[k];
                      if (slot == SpringPool::none) return;
                      auto& pool = list.pools[static_cast<std::size_t>(i / NeighborList::block)];
                      Quad const& s = springs.tangential[k];
                      pool.tangential()[slot] = {s.x, s.y, s.z};
                      if (!list.carries_rolling) return;
                      Quad const& r = springs.rolling[k];
                      pool.rolling()[slot] = {r.x, r.y, r.z};
                  });
}

}  // namespace gimdem

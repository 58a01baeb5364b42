// SPDX-License-Identifier: BSD-3-Clause
/// The springs of a list pair by pair, for whoever has no need of speed: files, devices, tests.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "search/NeighborList.hpp"

namespace gimdem
{

/// Particles [begin, end) of a block.
inline std::pair<std::int64_t, std::int64_t> block_of(NeighborListView const& list, std::int64_t block)
{
    std::int64_t const begin = block * NeighborList::block, end = begin + NeighborList::block;
    return {begin, end < list.particle_count ? end : list.particle_count};
}

/// Makes the pools of a list ready for so many springs in each block. Throws UserError for too many.
void reset_pools(NeighborList& list, std::span<std::int32_t const> counts);

/// Throws UserError where a block found no slot for a contact.
void require_springs(NeighborList const& list);

/// First particle of each pair.
exec::Buffer<std::int32_t> first_of_pairs(NeighborList const& list);
/// 1 for each pair that touches, 0 for the others.
exec::Buffer<std::uint8_t> touches_of_pairs(NeighborList const& list);
/// Of each pair, zero where it does not touch [m]; w: 0.
exec::Buffer<Quad> tangential_of_pairs(NeighborList const& list);
/// The same of the torque on the first [N m]; empty where no law has such a spring.
exec::Buffer<Quad> rolling_of_pairs(NeighborList const& list);

/// Springs of each pair. rolling: empty where no law has such.
struct SpringsOfPairs
{
    exec::Buffer<Quad> tangential;       ///< [m]
    exec::Buffer<Quad> rolling;          ///< [N m]
    exec::Buffer<std::uint8_t> touches;  ///< empty: all touch
};

/// Takes the pairs that do not touch out of a list, and their springs out of the others.
void keep_touching(NeighborList& list, SpringsOfPairs& springs);

/// Sets the springs of a list whose rows and second particles are set.
void put_springs(SpringsOfPairs const& springs, NeighborList& list);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// The springs of pairs while a new list takes the place of the old one, theory.md (D.76).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exec/Room.hpp"
#include "search/NeighborList.hpp"

namespace gimdem
{

/// What kernels see of the springs of the old list, by the numbers that particles had in it.
struct KeptSpringsView
{
    std::int32_t const* offsets;      ///< shape=(n_particles + 1,): members of i are [offsets i, i + 1)
    std::int32_t const* partner;      ///< of each member
    Spring const* const* tangential;  ///< of each block: of its members
    Spring const* const* rolling;     ///< the same; null where no law has such springs
    std::int32_t const* new_to_old;   ///< number that a particle had

    static constexpr std::int32_t none = -1;

    /// A pair of the new list in the old one.
    struct Place
    {
        std::int32_t low, member;  ///< old number of the first; none where the pair had no spring
        bool swapped;              ///< the first was the second: springs change their sign
    };

    Place find(std::int32_t first, std::int32_t second) const
    {
        std::int32_t const i = new_to_old[first], j = new_to_old[second];
        std::int32_t const low = i < j ? i : j, high = i < j ? j : i;
        for (std::int32_t member = offsets[low]; member < offsets[low + 1]; ++member)
            if (partner[member] == high) return {low, member, low != i};
        return {low, none, false};
    }

    /// One of the two kinds of spring at a place.
    Spring at(Spring const* const* springs, Place const& place) const
    {
        std::int64_t const block = place.low / NeighborList::block;
        Spring const& s = springs[block][place.member - offsets[block * NeighborList::block]];
        return place.swapped ? Spring{-s.x, -s.y, -s.z} : s;
    }
};

class KeptSprings
{
public:
    /// Copies the springs of all pairs that touch into `room`.
    void keep(exec::Execution const& execution, NeighborList& list, exec::Room& room);

    /// Gives them to the same pairs of a new list. Throws UserError where a block has too many.
    void give(exec::Execution const& execution, std::span<std::int32_t const> new_to_old, NeighborList& list) const;

private:
    std::int32_t const* offsets_ = nullptr;
    std::int32_t const* partner_ = nullptr;
    std::vector<Spring*> tangential_, rolling_;
};

}  // namespace gimdem

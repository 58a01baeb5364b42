// SPDX-License-Identifier: BSD-3-Clause
/// Which of the listed walls a particle touches.
#pragma once

#include <cstdint>

#include "exec/Octet.hpp"
#include "walls/WallBatch.hpp"
#include "walls/WallSprings.hpp"

namespace gimdem
{

/// The pairs of the list that WallContacts holds.
struct WallPairsView
{
    std::int32_t const* offsets;   ///< shape=(n_particles + 1,)
    std::int32_t const* particle;  ///< of each pair
    std::int32_t const* surface;   ///< of each pair
    std::int32_t const* row;       ///< of each pair: where its constants are in the table of materials
    std::uint8_t const* whole;     ///< of each pair
    std::uint8_t const* alone;     ///< of each pair
    Touch* places;                 ///< shape=(n_pairs,), or null where no particle has many pairs
};

/// The contacts of a particle near walls of any kind, and what becomes of their springs.
struct WallFinder
{
    NearbyWalls nearby;
    WallPairsView pairs;
    WallSprings springs;
    Quad const* position;
    Quad* force;  ///< of each pair [N]; w: 1 where it touches

    /// Finds the touches of pairs [begin, end) of a particle at x, its radius x.w; returns where they are: `at_hand`,
    /// or the places of a particle with many.
    GIMDEM_HD Touch const* operator()(Quad const& x, std::int32_t begin, std::int32_t end, Touch* at_hand,
                                      std::int32_t& count) const
    {
        Touch* const touches = end - begin > WallTouches::most_at_hand ? pairs.places + begin : at_hand;
        WallTouches const walls{nearby, pairs.surface, pairs.whole};
        count = walls.find(x, begin, end, touches);
        walls.weed(x.w, touches, count);
        SpringMover{walls, springs, begin, end}(touches, count);
        return touches;
    }

    /// Looks at pairs from k on of which each can be told by itself, at most eight; returns the next.
    GIMDEM_FLATTEN std::int32_t look(std::int32_t k, std::int32_t end, WallBatch& found) const
    {
        int count = 1;
        while (count < exec::octet && k + count < end && pairs.alone[k + count] != 0)
            ++count;
        std::int32_t i[exec::octet];
        Quad wall[exec::octet];
        for (int n = 0; n < exec::octet; ++n)
        {
            std::int32_t const pair = n < count ? k + n : k;
            i[n] = pairs.particle[pair];
            wall[n] = nearby.walls.surfaces[pairs.surface[pair]].normal;
        }
        auto const x = exec::load(position, i);
        auto const plane = exec::load(wall, in_order);
        exec::Octet const overlap = x.w - (plane.x * x.x + plane.y * x.y + plane.z * x.z - plane.w);
        exec::OctetMask const touching = exec::greater(overlap, exec::Octet::Constant(0));
        for (int n = 0; n < count; ++n)
        {
            if (touching.lanes[n] != 0)
            {
                Quad const& to = wall[n];
                found.add(i[n], k + n, pairs.row[k + n], {to.x, to.y, to.z, overlap[n]});
                continue;
            }
            if (force[k + n].w == 0) continue;
            springs.drop(k + n);
            force[k + n] = {0, 0, 0, 0};
        }
        return k + count;
    }

    static constexpr std::int32_t in_order[exec::octet] = {0, 1, 2, 3, 4, 5, 6, 7};
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Pairs of particles by id: those of a list, and those that looking at every pair gives.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "particles/ParticleState.hpp"
#include "search/NeighborList.hpp"
#include "search/PairSprings.hpp"

namespace gimdem::test
{

using Pairs = std::set<std::pair<std::int64_t, std::int64_t>>;

/// Distance to the nearest of the 27 images, by trying each.
inline double distance_to_image(Vec3 const& a, Vec3 const& b, Domain const& domain)
{
    double least = (a - b).norm();
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                least = std::min(least, (a - b + domain.period.vec().cwiseProduct(Vec3(x, y, z))).norm());
    return least;
}

inline Pairs by_brute_force(ParticleState const& p, double skin, Domain const& domain = {})
{
    Pairs pairs;
    for (std::int64_t i = 0; i < p.count(); ++i)
        for (std::int64_t j = 0; j < p.count(); ++j)
            if (p.id[i] < p.id[j] && distance_to_image(p.position[i].xyz(), p.position[j].xyz(), domain) <
                                         p.position[i].w + p.position[j].w + skin)
                pairs.emplace(p.id[i], p.id[j]);
    return pairs;
}

inline Pairs ids_of(ParticleState const& p, NeighborList const& list)
{
    Pairs pairs;
    auto const first = first_of_pairs(list);
    for (std::int64_t k = 0; k < list.pair_count(); ++k)
    {
        auto const a = p.id[first[k]], b = p.id[list.second[k]];
        pairs.emplace(std::min(a, b), std::max(a, b));
    }
    return pairs;
}

/// The list holds `expected`, each pair once, in the layout that NeighborList promises.
inline void expect_list(ParticleState const& p, NeighborList const& list, Pairs const& expected)
{
    EXPECT_EQ(ids_of(p, list), expected);
    ASSERT_EQ(static_cast<std::size_t>(list.pair_count()), expected.size());
    ASSERT_EQ(list.row_offsets.size(), p.count() + 1);
    EXPECT_EQ(list.row_offsets[p.count()], list.pair_count());
    for (std::int64_t i = 0; i < p.count(); ++i)
        for (std::int32_t k = list.row_offsets[i]; k < list.row_offsets[i + 1]; ++k)
        {
            EXPECT_EQ(list.first_in_block[k], i % NeighborList::block);
            EXPECT_LT(k == list.row_offsets[i] ? i : list.second[k - 1], list.second[k]);
        }
    // Slots are numbered along the list.
    std::vector<std::int32_t> second_of_slot;
    for (std::int64_t i = 0; i < p.count(); ++i)
        for (std::int32_t k = list.row_offsets[i]; k < list.row_offsets[i + 1]; ++k)
            if (i / NeighborList::block != list.second[k] / NeighborList::block)
                second_of_slot.push_back(list.second[k]);
    auto const& by_second = list.border.by_second;
    ASSERT_EQ(by_second.members.size(), std::ssize(second_of_slot));
    for (std::int64_t j = 0; j < p.count(); ++j)
        for (std::int32_t m = by_second.offsets[j]; m < by_second.offsets[j + 1]; ++m)
            EXPECT_EQ(second_of_slot[static_cast<std::size_t>(by_second.members[m])], j);
}

}  // namespace gimdem::test

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

/// A spring that tells its pair, and by its sign who comes first in it.
inline Vec3 spring_of(std::int64_t a, std::int64_t b)
{
    return (a < b ? 1.0 : -1.0) * Vec3(1, static_cast<double>(a + b), static_cast<double>(a * b));
}
/// Puts spring_of() on every pair.
inline void give_springs(ParticleState const& p, NeighborList& list)
{
    auto const first = first_of_pairs(list);
    SpringsOfPairs springs{tangential_of_pairs(list), {}, {}};
    for (std::int64_t k = 0; k < list.pair_count(); ++k)
        springs.tangential[k] = Quad::of(spring_of(p.id[first[k]], p.id[list.second[k]]), 0);
    put_springs(springs, list);
}
/// Pairs of `before` have the springs of give_springs(), all others none. Returns how many those are.
inline int expect_springs_of(Pairs const& before, ParticleState const& p, NeighborList const& list)
{
    int kept = 0;
    auto const first = first_of_pairs(list);
    auto const carried = tangential_of_pairs(list);
    for (std::int64_t k = 0; k < list.pair_count(); ++k)
    {
        auto const a = p.id[first[k]], b = p.id[list.second[k]];
        bool const known = before.contains({std::min(a, b), std::max(a, b)});
        EXPECT_EQ(carried[k].xyz(), known ? spring_of(a, b) : Vec3(Vec3::Zero()));
        kept += known;
    }
    return kept;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "search/NeighborList.hpp"

#include <gtest/gtest.h>

#include "Pairs.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"

namespace
{

using gimdem::NeighborList;
using gimdem::NeighborSearch;
using gimdem::ParticleState;
using gimdem::Vec3;
using namespace gimdem::test;

TEST(NeighborList, HoldsThePairsOfBruteForceEachOnce)
{
    for (double const smallest : {0.05, 0.005})  // equal-ish radii and 10:1
    {
        ParticleState p = particles_of(random_spheres(400, {0, 0, 0}, {1, 0.7, 1.3}, smallest, 0.05));
        Pairs const expected = by_brute_force(p, 0.01);
        NeighborList list;
        NeighborSearch(serial, 0.01).build(p, list);
        EXPECT_EQ(ids_of(p, list), expected);
        EXPECT_EQ(static_cast<std::size_t>(list.pair_count()), expected.size());
        EXPECT_GT(expected.size(), 50u);
    }
}

TEST(NeighborList, SpringsFollowTheirPairsThroughAReordering)
{
    ParticleState p = particles_of(random_spheres(200, {0, 0, 0}, {1, 1, 1}, 0.05, 0.05));
    NeighborList list;
    NeighborSearch search(serial, 0.05);
    search.build(p, list);
    give_springs(p, list);
    Pairs const before = ids_of(p, list);
    for (std::int64_t i = 0; i < p.count(); ++i)
        p.position[i].set_xyz(Vec3(1, 1, 1) - 1.01 * p.position[i].xyz());

    search.build(p, list);

    EXPECT_GT(expect_springs_of(before, p, list), 100);
}

TEST(NeighborList, GoesStaleBeyondHalfTheSkin)
{
    ParticleState p = particles_of(random_spheres(10, {0, 0, 0}, {1, 1, 1}, 0.05, 0.05));
    NeighborList list;
    NeighborSearch search(serial, 0.02);
    EXPECT_TRUE(search.is_stale(p, list));
    search.build(p, list);
    p.position[3].y += 0.0099;
    EXPECT_FALSE(search.is_stale(p, list));
    p.position[3].y += 0.0002;
    EXPECT_TRUE(search.is_stale(p, list));
    p.position[3].y = NAN;
    EXPECT_TRUE(search.is_stale(p, list));
    EXPECT_THROW(search.build(p, list), gimdem::UserError);
}

TEST(NeighborList, NoParticlesAndOneParticleAreFine)
{
    for (int const count : {0, 1})
    {
        ParticleState p = particles_of(random_spheres(count, {0, 0, 0}, {1, 1, 1}, 0.05, 0.05));
        NeighborList list;
        NeighborSearch(serial, 0.02).build(p, list);
        EXPECT_EQ(list.pair_count(), 0);
    }
}

}  // namespace

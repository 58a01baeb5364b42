// SPDX-License-Identifier: BSD-3-Clause
#include "search/SpringPool.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "Pairs.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "exec/Room.hpp"
#include "search/PairSprings.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

bool is_at_rest(Spring const& s)
{
    return s.x == 0 && s.y == 0 && s.z == 0;
}

TEST(SpringPool, GivesEverySlotOnceAndAtRest)
{
    SpringPool pool;
    pool.reset(3, true);
    for (int slot : {0, 1, 2})
        pool.tangential()[slot] = pool.rolling()[slot] = {1, 2, 3};
    pool.give_back(1);
    pool.give_back(0);

    std::set<int> const slots{pool.take(), pool.take(), pool.take()};

    EXPECT_EQ(slots, (std::set<int>{0, 1, 3}));  // those that were free first
    for (int const slot : slots)
    {
        EXPECT_TRUE(is_at_rest(pool.tangential()[slot])) << slot;
        EXPECT_TRUE(is_at_rest(pool.rolling()[slot])) << slot;
    }
    EXPECT_EQ(pool.tangential()[2].y, 2);
    EXPECT_FALSE(pool.is_short());
}

TEST(SpringPool, TellsWhenNumbersRunOut)
{
    SpringPool pool;
    pool.reset(SpringPool::none - 1, false);
    EXPECT_EQ(pool.take(), SpringPool::none - 1);
    EXPECT_FALSE(pool.is_short());
    EXPECT_EQ(pool.take(), SpringPool::none);
    EXPECT_TRUE(pool.is_short());
}

TEST(SpringPool, AListWithTooManyContactsIsRefused)
{
    NeighborList list;
    std::int32_t const counts[] = {SpringPool::none};
    EXPECT_THROW(reset_pools(list, counts), UserError);
}

TEST(SpringPool, HoldsSpringsOfTouchingPairsAloneAfterARebuild)
{
    // A row of spheres: each touches the next one, and lists the one after that.
    std::vector<Sphere> spheres;
    for (int i = 0; i < 2000; ++i)
        spheres.push_back({{1.99 * i, 0, 0}, 1});
    ParticleState p = particles_of(spheres);
    NeighborList list;
    NeighborSearch search(serial, 2.5);
    search.build(p, list);
    ASSERT_EQ(list.pair_count(), 1999 + 1998);
    SpringsOfPairs springs{tangential_of_pairs(list), {}, exec::Buffer<std::uint8_t>(list.pair_count())};
    auto const first = first_of_pairs(list);
    for (std::int64_t k = 0; k < list.pair_count(); ++k)
    {
        springs.touches[k] = list.second[k] == first[k] + 1;
        springs.tangential[k] = {double(first[k]), 1, 2, 0};
    }
    put_springs(springs, list);

    search.build(p, list);

    auto const touches = touches_of_pairs(list);
    auto const carried = tangential_of_pairs(list);
    std::set<std::pair<std::int64_t, int>> slots;
    for (std::int64_t k = 0; k < list.pair_count(); ++k)
    {
        EXPECT_EQ(touches[k], list.second[k] == first[k] + 1);
        EXPECT_EQ(carried[k].x, touches[k] != 0 ? double(first[k]) : 0);
        if (touches[k] != 0) slots.emplace(first[k] / NeighborList::block, list.spring[k]);
    }
    ASSERT_EQ(slots.size(), 1999u);
    EXPECT_EQ(slots.begin()->second, 0);
    EXPECT_EQ(slots.rbegin()->second, 1999 - 1024 - 1);  // without a gap
}

TEST(Room, GivesPlacesOfWhatWasLentAndThenItsOwn)
{
    exec::Buffer<double> lent(32);  // 256 bytes
    exec::Room room;
    room.lend(lent);
    auto* const a = room.take<std::int32_t>(3);  // of 64 bytes, as places begin on lines of the cache
    auto* const b = room.take<double>(20);       // of 192
    auto* const c = room.take<double>(1);
    EXPECT_EQ(static_cast<void*>(a), lent.view().data);
    EXPECT_EQ(b, lent.view().data + 8);
    EXPECT_TRUE(c < lent.view().data || c >= lent.view().data + 32);
    room.clear();
    EXPECT_EQ(room.take<double>(1), c);  // kept for the next time
}

}  // namespace

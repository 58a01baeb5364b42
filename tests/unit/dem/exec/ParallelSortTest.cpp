// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "exec/Sort.hpp"

namespace
{

using namespace gimdem::exec;

Execution const three{Backend::openmp, 3};

std::vector<std::int32_t> random_keys(int count, int n_keys)
{
    std::mt19937 random(3);
    std::vector<std::int32_t> keys;
    for (int i = 0; i < count; ++i)
        keys.push_back(static_cast<std::int32_t>(random() % static_cast<unsigned>(n_keys)));
    return keys;
}

TEST(ParallelSort, GroupsAreThoseOfTheSerialSort)
{
    // Few and many keys, above and below the size of a block; one key takes all.
    for (auto const& [count, n_keys] :
         {std::pair{0, 5}, {100, 7}, {20000, 1}, {20000, 255}, {20000, 257}, {20000, 150'000}, {4097, 3}})
    {
        auto const keys = random_keys(count, n_keys);
        Groups expected, groups;

        group_by_key(keys, n_keys, expected);
        group_by_key(three, keys, n_keys, groups);

        EXPECT_TRUE(std::ranges::equal(groups.offsets.host(), expected.offsets.host())) << count << ' ' << n_keys;
        EXPECT_TRUE(std::ranges::equal(groups.members.host(), expected.members.host())) << count << ' ' << n_keys;
    }
}

TEST(ParallelSort, ScanIsThatOfTheSerialScan)
{
    for (int const count : {1, 4096, 4097, 20001})
    {
        std::vector<std::int32_t> expected = random_keys(count, 1000), counts = expected;

        std::int64_t const total = exclusive_scan(expected);

        EXPECT_EQ(exclusive_scan(three, counts), total);
        EXPECT_EQ(counts, expected);
    }
}

}  // namespace

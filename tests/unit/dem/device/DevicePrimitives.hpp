// SPDX-License-Identifier: BSD-3-Clause
/// What scan, sort and reduction must do on any device; for tests that g++ compiles and tests that nvcc compiles.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "engine/device/Reductions.hpp"
#include "exec/Sort.hpp"
#include "exec/device/DeviceReduce.hpp"
#include "exec/device/DeviceSort.hpp"

namespace gimdem::test
{

inline std::vector<std::int32_t> random_numbers(int count, int below)
{
    std::mt19937 random(3);
    std::vector<std::int32_t> numbers;
    for (int i = 0; i < count; ++i)
        numbers.push_back(static_cast<std::int32_t>(random() % static_cast<unsigned>(below)));
    return numbers;
}

template <class Device>
void expect_scan_of_the_host(Device& device)
{
    exec::DeviceScan<Device> scan;
    for (int const count : {1, 2, 64, 65, 300, 64 * 64 + 1, 20001})
    {
        std::vector<std::int32_t> expected = random_numbers(count, 1000);
        exec::DeviceArray<Device, std::int32_t> counts;
        exec::Buffer<std::int32_t> result;
        counts.upload(device, expected);

        scan(device, counts.view());
        counts.download(device, result);
        device.wait();

        exec::exclusive_scan(expected);
        EXPECT_TRUE(std::ranges::equal(result.host(), expected)) << count;
    }
}

template <class Device>
void expect_groups_of_the_host(Device& device)
{
    exec::DeviceSort<Device> sort;
    // Few and many keys, none in some groups, above and below the size of a block.
    for (auto const& [count, n_keys] :
         {std::pair{0, 5}, {1, 1}, {100, 7}, {257, 16}, {300, 17}, {3000, 1}, {3000, 257}, {3000, 150'000}})
    {
        auto const keys = random_numbers(count, n_keys);
        exec::Groups expected;
        exec::group_by_key(keys, n_keys, expected);
        exec::DeviceArray<Device, std::int32_t> on_device;
        exec::DeviceGroups<Device> groups;
        exec::Buffer<std::int32_t> offsets, members;
        on_device.upload(device, keys);

        sort(device, {on_device.data(), on_device.size()}, n_keys, groups);
        groups.offsets.download(device, offsets);
        groups.members.download(device, members);
        device.wait();

        EXPECT_TRUE(std::ranges::equal(offsets.host(), expected.offsets.host())) << count << ' ' << n_keys;
        EXPECT_TRUE(std::ranges::equal(members.host(), expected.members.host())) << count << ' ' << n_keys;
    }
}

template <class Device>
void expect_whole_sums(Device& device)
{
    exec::DeviceReduce<Device, std::int64_t> sum(device);
    for (int const count : {0, 1, 32, 33, 5000})
    {
        auto const numbers = random_numbers(count, 1000);
        exec::DeviceArray<Device, std::int32_t> values;
        values.upload(device, numbers);

        std::int64_t const result = sum(count, EntryOf<std::int64_t, std::int32_t>{values.data()}, Add<std::int64_t>{});

        std::int64_t expected = 0;
        for (std::int32_t const number : numbers)
            expected += number;
        EXPECT_EQ(result, expected) << count;
    }
}

/// Of numbers whose sum depends on the order.
template <class Device>
double sum_of_roots(Device& device)
{
    std::vector<double> roots;
    for (int i = 0; i < 5000; ++i)
        roots.push_back(std::sqrt(i));
    exec::DeviceArray<Device, double> values;
    values.upload(device, roots);
    exec::DeviceReduce<Device, double> sum(device);
    return sum(values.size(), EntryOf<double>{values.data()}, Add<double>{});
}

}  // namespace gimdem::test

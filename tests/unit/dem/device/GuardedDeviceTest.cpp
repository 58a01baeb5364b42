// SPDX-License-Identifier: BSD-3-Clause
/// The guarded device must find the mistakes that it is there for.
#include "exec/guarded/GuardedDevice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "DevicePrimitives.hpp"

namespace
{

using namespace gimdem::exec;

struct Twice
{
    double const* from;
    double* to;
    void operator()(Index i) const { to[i] = 2 * from[i]; }
};

/// What kernels must not do: the result depends on the order.
struct Running
{
    std::int32_t* last;
    std::int32_t* seen;
    void operator()(Index i) const
    {
        seen[i] = *last;
        *last = static_cast<std::int32_t>(i);
    }
};

struct Device
{
    GuardedDevice device;
    DeviceArray<GuardedDevice, double> from, to;

    Device()
    {
        from.upload(device, std::vector<double>{1, 2, 3});
        to.resize(device, 3);
    }
};

TEST(GuardedDevice, RunsAKernelOnWhatWasCopiedToIt)
{
    Device d;
    Buffer<double> result;

    d.device.for_each(3, Twice{d.from.data(), d.to.data()});
    d.to.download(d.device, result);
    d.device.wait();

    EXPECT_EQ(std::vector<double>(result.host().begin(), result.host().end()), (std::vector<double>{2, 4, 6}));
}

TEST(GuardedDevice, RefusesAKernelThatHoldsAPointerOfTheHost)
{
    Device d;
    std::vector<double> host(3);

    EXPECT_THROW(d.device.for_each(3, Twice{host.data(), d.to.data()}), std::logic_error);
    EXPECT_THROW(d.device.for_each(3, Twice{d.from.data(), host.data()}), std::logic_error);
}

TEST(GuardedDevice, RefusesAKernelThatHoldsFreedMemory)
{
    Device d;
    double const* const old = d.from.data();
    d.from.resize(d.device, 100'000);

    EXPECT_THROW(d.device.for_each(3, Twice{old, d.to.data()}), std::logic_error);
}

TEST(GuardedDevice, RefusesACopyFromTheHostAsIfItWereFromADevice)
{
    Device d;
    std::vector<double> host(3);
    double to[3];

    EXPECT_THROW(d.device.copy_out(to, host.data(), sizeof to), std::logic_error);
    EXPECT_THROW(d.device.copy_in(host.data(), to, sizeof to), std::logic_error);
}

TEST(GuardedDeviceDeathTest, TheHostCannotLookIntoItsMemory)
{
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(
        {
            Device d;
            double const volatile* const p = d.from.data();
            std::exit(static_cast<int>(p[0]));
        },
        "");
}

TEST(GuardedDevice, AResultArrivesWithWaitAndNotBefore)
{
    Device d;
    Buffer<double> result;

    d.from.download(d.device, result);
    EXPECT_TRUE(std::isnan(result[0]));
    d.device.wait();
    EXPECT_EQ(result[0], 1);
}

TEST(GuardedDevice, WhatWasNeverWrittenIsNotANumber)
{
    Device d;
    Buffer<double> result;

    d.to.download(d.device, result);
    d.device.wait();

    EXPECT_TRUE(std::isnan(result[2]));
}

TEST(GuardedDevice, KernelsRunInAnotherOrderEachTimeAndVisitEachIndexOnce)
{
    Device d;
    DeviceArray<GuardedDevice, std::int32_t> last, seen;
    last.resize(d.device, 1);
    seen.resize(d.device, 1000);
    Buffer<std::int32_t> orders[2];
    for (auto& order : orders)
    {
        last.upload(d.device, std::vector<std::int32_t>{-1});
        d.device.for_each(1000, Running{last.data(), seen.data()});
        seen.download(d.device, order);
        d.device.wait();
        // Each index follows another one, and one follows none.
        auto sorted = std::vector<std::int32_t>(order.host().begin(), order.host().end());
        std::ranges::sort(sorted);
        EXPECT_EQ(std::ranges::adjacent_find(sorted), sorted.end());
        EXPECT_EQ(sorted.front(), -1);
    }
    EXPECT_FALSE(std::ranges::equal(orders[0].host(), orders[1].host()));
}

TEST(GuardedDevice, ScanIsThatOfTheHost)
{
    for (unsigned const seed : {1u, 2u})
    {
        GuardedDevice device(seed);
        gimdem::test::expect_scan_of_the_host(device);
    }
}

TEST(GuardedDevice, SortIsThatOfTheHost)
{
    for (int const threads : {1, 2})
    {
        GuardedDevice device(3, threads);
        gimdem::test::expect_groups_of_the_host(device);
    }
}

TEST(GuardedDevice, ReductionsAreExactInWholeNumbersAndTheSameInAnyOrder)
{
    GuardedDevice one(1), other(9, 2);
    gimdem::test::expect_whole_sums(one);
    EXPECT_EQ(gimdem::test::sum_of_roots(one), gimdem::test::sum_of_roots(other));
}

}  // namespace

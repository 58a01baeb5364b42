// SPDX-License-Identifier: BSD-3-Clause
/// The devices that tests run on: the guarded one, in different orders and on different numbers of threads, and GPUs
/// where there are any, with either way to scan and sort.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "exec/Execution.hpp"

namespace gimdem::test
{

inline exec::Execution guarded(unsigned seed = 1, int threads = 1)
{
    return {exec::Backend::guarded, threads, exec::Sorting::plain, seed};
}

inline exec::Execution gpu(exec::Sorting sorting)
{
    return {exec::Backend::cuda, 1, sorting};
}

inline std::string name_of(testing::TestParamInfo<exec::Execution> const& info)
{
    exec::Execution const& e = info.param;
    if (e.backend == exec::Backend::cuda) return e.sorting == exec::Sorting::plain ? "plain" : "library";
    return "seed" + std::to_string(e.seed) + "threads" + std::to_string(e.threads);
}

/// A test that runs on each device. GIMDEM_ON_DEVICES(Name) after the tests instantiates it; those on GPUs are called
/// Gpu/..., and skip where there is none.
class OnDevice : public testing::TestWithParam<exec::Execution>
{
protected:
    void SetUp() override
    {
        if (GetParam().backend == exec::Backend::cuda && !exec::cuda_is_there())
            GTEST_SKIP() << "no GPU here, or a build without CUDA";
    }
    /// The same device, with kernels in another order where that can be chosen.
    exec::Execution in_another_order() const
    {
        exec::Execution other = GetParam();
        other.seed += 17;
        return other;
    }
};

}  // namespace gimdem::test

#define GIMDEM_ON_DEVICES(Name)                                                                                     \
    INSTANTIATE_TEST_SUITE_P(Guarded, Name, testing::Values(gimdem::test::guarded(1), gimdem::test::guarded(5, 2)), \
                             gimdem::test::name_of);                                                                \
    INSTANTIATE_TEST_SUITE_P(Gpu, Name,                                                                             \
                             testing::Values(gimdem::test::gpu(gimdem::exec::Sorting::library),                     \
                                             gimdem::test::gpu(gimdem::exec::Sorting::plain)),                      \
                             gimdem::test::name_of)

// SPDX-License-Identifier: BSD-3-Clause
/// Scan, sort and reduction on a GPU, by plain kernels and by CUB.
#include <gtest/gtest.h>

#include "DevicePrimitives.hpp"
#include "exec/cuda/CudaDevice.hpp"

namespace
{

using namespace gimdem::exec;

class GpuPrimitives : public testing::TestWithParam<Sorting>
{
protected:
    void SetUp() override
    {
        if (!cuda_is_there()) GTEST_SKIP() << "no GPU here";
    }
};

TEST_P(GpuPrimitives, ScanIsThatOfTheHost)
{
    CudaDevice device(GetParam());
    gimdem::test::expect_scan_of_the_host(device);
}

TEST_P(GpuPrimitives, SortIsThatOfTheHost)
{
    CudaDevice device(GetParam());
    gimdem::test::expect_groups_of_the_host(device);
}

TEST_P(GpuPrimitives, ReductionsAreExactInWholeNumbers)
{
    CudaDevice device(GetParam());
    gimdem::test::expect_whole_sums(device);
    EXPECT_EQ(gimdem::test::sum_of_roots(device), gimdem::test::sum_of_roots(device));
}

INSTANTIATE_TEST_SUITE_P(Gpu, GpuPrimitives, testing::Values(Sorting::plain, Sorting::library));

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
// Scan and sort by CUB: apart from the rest, because no other file takes so long to compile.
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>

#include "exec/cuda/CudaDevice.hpp"

namespace gimdem::exec
{

using detail::check;

bool CudaDevice::scan_by_library(View<std::int32_t> values)
{
    if (sorting_ != Sorting::library) return false;
    auto const count = static_cast<int>(values.size);
    std::size_t bytes = 0;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, values.data, values.data, count, stream_), "a scan");
    void* const scratch_memory = scratch(bytes);
    check(cub::DeviceScan::ExclusiveSum(scratch_memory, bytes, values.data, values.data, count, stream_), "a scan");
    return true;
}

bool CudaDevice::sort_by_library(View<std::int32_t const> keys, std::int32_t const* members, int bits,
                                 std::int32_t* sorted_keys, std::int32_t* sorted_members)
{
    if (sorting_ != Sorting::library) return false;
    auto const count = static_cast<int>(keys.size);
    std::size_t bytes = 0;
    auto const sort = [&](void* memory)
    {
        check(cub::DeviceRadixSort::SortPairs(memory, bytes, keys.data, sorted_keys, members, sorted_members, count, 0,
                                              bits, stream_),
              "a sort");
    };
    sort(nullptr);
    sort(scratch(bytes));
    return true;
}

}  // namespace gimdem::exec

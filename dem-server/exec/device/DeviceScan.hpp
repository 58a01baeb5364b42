// SPDX-License-Identifier: BSD-3-Clause
/// Exclusive scan on a device by plain kernels: sums of blocks, the same of the sums, and so on; then back.
#pragma once

#include <cstdint>

#include "exec/device/DeviceArray.hpp"

namespace gimdem::exec
{

namespace detail
{

inline constexpr Index scan_block = 64;

/// Sum of each block.
struct BlockSum
{
    std::int32_t const* values;
    Index count;
    std::int32_t* sums;

    GIMDEM_HD void operator()(Index b) const
    {
        Index const end = (b + 1) * scan_block < count ? (b + 1) * scan_block : count;
        std::int32_t sum = 0;
        for (Index i = b * scan_block; i < end; ++i)
            sum += values[i];
        sums[b] = sum;
    }
};

/// Scan of each block, in place, from where the blocks before have got to.
struct BlockScan
{
    std::int32_t* values;
    Index count;
    std::int32_t const* starts;  ///< null: a single block

    GIMDEM_HD void operator()(Index b) const
    {
        Index const end = (b + 1) * scan_block < count ? (b + 1) * scan_block : count;
        std::int32_t at = starts == nullptr ? 0 : starts[b];
        for (Index i = b * scan_block; i < end; ++i)
        {
            std::int32_t const value = values[i];
            values[i] = at;
            at += value;
        }
    }
};

}  // namespace detail

/// Scans on one device; keeps what it needs for the next time.
template <class Device>
class DeviceScan
{
public:
    /// counts -> offsets in place: each entry becomes the sum of those before it. So of n counts and one more entry,
    /// ignored, the last becomes the total.
    void operator()(Device& device, View<std::int32_t> values)
    {
        if (values.size == 0) return;
        device.zero(values.data + values.size - 1, sizeof(std::int32_t));  // in no sum; whoever reads it reads a number
        if (device.scan_by_library(values)) return;
        sums_.resize(device, room(values.size));
        scan(device, values, sums_.data());
    }

private:
    /// Blocks of all levels together.
    static Index room(Index count)
    {
        Index sum = 0;
        while (count > detail::scan_block)
            sum += count = (count + detail::scan_block - 1) / detail::scan_block;
        return sum;
    }

    static void scan(Device& device, View<std::int32_t> values, std::int32_t* sums)
    {
        Index const blocks = (values.size + detail::scan_block - 1) / detail::scan_block;
        if (blocks > 1)
        {
            device.for_each(blocks, detail::BlockSum{values.data, values.size, sums});
            scan(device, {sums, blocks}, sums + blocks);
        }
        device.for_each(blocks, detail::BlockScan{values.data, values.size, blocks > 1 ? sums : nullptr});
    }

    DeviceArray<Device, std::int32_t> sums_;
};

}  // namespace gimdem::exec

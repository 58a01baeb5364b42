// SPDX-License-Identifier: BSD-3-Clause
/// Stable grouping by key on a device: the same result as group_by_key of exec/Sort.hpp.
#pragma once

#include <cstdint>

#include "exec/device/DeviceScan.hpp"

namespace gimdem::exec
{

namespace detail
{

inline constexpr Index sort_block = 256;
inline constexpr int digit_bits = 4;
inline constexpr int digits = 1 << digit_bits;

struct Iota
{
    std::int32_t* values;
    GIMDEM_HD void operator()(Index i) const { values[i] = static_cast<std::int32_t>(i); }
};

/// Counts, then moves, the members of one block by one digit of their key. places: shape=(digits, n_blocks).
struct DigitKernel
{
    View<std::int32_t const> keys;
    std::int32_t const* members;
    int shift;
    Index blocks;
    std::int32_t* places;      ///< counts while counting
    std::int32_t* moved_keys;  ///< null: count
    std::int32_t* moved_members;

    GIMDEM_HD void operator()(Index b) const
    {
        std::int32_t at[digits];
        for (int d = 0; d < digits; ++d)
            at[d] = moved_keys == nullptr ? 0 : places[d * blocks + b];
        Index const end = (b + 1) * sort_block < keys.size ? (b + 1) * sort_block : keys.size;
        for (Index i = b * sort_block; i < end; ++i)
        {
            std::int32_t const to = at[(keys[i] >> shift) & (digits - 1)]++;
            if (moved_keys == nullptr) continue;
            moved_keys[to] = keys[i];
            moved_members[to] = members[i];
        }
        for (int d = 0; d < digits && moved_keys == nullptr; ++d)
            places[d * blocks + b] = at[d];
    }
};

/// Entry i of the sorted keys is where all keys after that of entry i - 1, up to its own, begin.
struct GroupBegin
{
    View<std::int32_t const> keys;
    std::int32_t n_keys;
    std::int32_t* offsets;

    GIMDEM_HD void operator()(Index i) const
    {
        std::int32_t const last = i < keys.size ? keys[i] : n_keys;
        for (std::int32_t k = i > 0 ? keys[i - 1] + 1 : 0; k <= last; ++k)
            offsets[k] = static_cast<std::int32_t>(i);
    }
};

}  // namespace detail

/// Members grouped by key, see exec/Sort.hpp.
template <class Device>
struct DeviceGroups
{
    DeviceArray<Device, std::int32_t> offsets;  ///< shape=(n_keys + 1,)
    DeviceArray<Device, std::int32_t> members;  ///< shape=(n_members,)
};

/// Sorts on one device; keeps what it needs for the next time.
template <class Device>
class DeviceSort
{
public:
    /// Group 0..keys.size-1 by keys[i] in [0, n_keys).
    void operator()(Device& device, View<std::int32_t const> keys, std::int32_t n_keys, DeviceGroups<Device>& groups)
    {
        Index const n = keys.size;
        groups.offsets.resize(device, n_keys + 1);
        groups.members.resize(device, n);
        sorted_keys_.resize(device, n);
        int bits = 1;
        while (bits < 31 && (std::int64_t{1} << bits) < n_keys)
            ++bits;
        members_.resize(device, n);
        device.for_each(n, detail::Iota{members_.data()});
        if (!device.sort_by_library(keys, members_.data(), bits, sorted_keys_.data(), groups.members.data()))
            sort(device, keys, bits, groups);
        device.for_each(n + 1, detail::GroupBegin{{sorted_keys_.data(), n}, n_keys, groups.offsets.data()});
    }

private:
    /// By the lowest digit, then the next, each time stably.
    void sort(Device& device, View<std::int32_t const> keys, int bits, DeviceGroups<Device>& groups)
    {
        Index const blocks = (keys.size + detail::sort_block - 1) / detail::sort_block;
        places_.resize(device, detail::digits * blocks);
        keys_.resize(device, keys.size);
        std::int32_t const* from = keys.data;
        for (int shift = 0; shift < bits; shift += detail::digit_bits)
        {
            detail::DigitKernel kernel{{from, keys.size}, members_.data(), shift,  blocks,
                                       places_.data(),    nullptr,         nullptr};
            device.for_each(blocks, kernel);
            scan_(device, places_.view());
            kernel.moved_keys = sorted_keys_.data();
            kernel.moved_members = groups.members.data();
            device.for_each(blocks, kernel);
            swap(keys_, sorted_keys_);
            swap(members_, groups.members);
            from = keys_.data();
        }
        swap(keys_, sorted_keys_);
        swap(members_, groups.members);
    }

    DeviceScan<Device> scan_;
    DeviceArray<Device, std::int32_t> keys_, sorted_keys_, members_, places_;
};

}  // namespace gimdem::exec

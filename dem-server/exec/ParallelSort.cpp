// SPDX-License-Identifier: BSD-3-Clause
// Scan and stable counting sort on several threads, over blocks whose size does not depend on their number. Both have
// one right result, so it is that of the serial ones to the bit.
#include <algorithm>
#include <utility>
#include <vector>

#include "exec/Sort.hpp"

namespace gimdem::exec
{

namespace
{

constexpr Index block = 4096;
constexpr Index most_buckets = 256;

Index blocks_of(Index count)
{
    return (count + block - 1) / block;
}

/// Whether threads are not worth while, or not there.
bool is_small(Execution const& execution, Index count)
{
    return execution.backend == Backend::serial || execution.threads == 1 || count <= block;
}

/// Keys that agree in all but their lowest `shift` bits share a bucket.
int shift_for(std::int64_t n_keys)
{
    int shift = 0;
    while (((n_keys - 1) >> shift) >= most_buckets)
        ++shift;
    return shift;
}

/// Counts, then writes, the members of one block by bucket. places: shape=(n_buckets, n_blocks).
struct BucketKernel
{
    View<std::int32_t const> keys;
    int shift;
    Index blocks;
    std::int32_t* places;   ///< counts while counting
    std::int32_t* members;  ///< null: count

    void operator()(Index b) const
    {
        std::int32_t at[most_buckets]{};
        Index const end = std::min(keys.size, (b + 1) * block);
        if (members == nullptr)
        {
            for (Index i = b * block; i < end; ++i)
                ++at[keys[i] >> shift];
            for (Index k = 0; k < most_buckets; ++k)
                places[k * blocks + b] = at[k];
            return;
        }
        for (Index k = 0; k < most_buckets; ++k)
            at[k] = places[k * blocks + b];
        for (Index i = b * block; i < end; ++i)
            members[at[keys[i] >> shift]++] = static_cast<std::int32_t>(i);
    }
};

/// Sorts the members of one bucket, which are in rising order, by key.
struct KeyKernel
{
    std::int32_t const* keys;
    int shift;
    Index blocks, n_keys;
    std::int32_t const* places;
    std::int32_t const* members;
    std::int32_t* offsets;
    std::int32_t* sorted;

    void operator()(Index bucket) const
    {
        Index const first = bucket << shift;
        Index const last = std::min(n_keys, (bucket + 1) << shift);
        if (first >= last) return;
        std::int32_t const begin = places[bucket * blocks], end = places[(bucket + 1) * blocks];
        std::fill(offsets + first, offsets + last, 0);
        for (std::int32_t m = begin; m < end; ++m)
            ++offsets[keys[members[m]]];
        std::int32_t at = begin;
        for (Index k = first; k < last; ++k)
            at += std::exchange(offsets[k], at);
        for (std::int32_t m = begin; m < end; ++m)
            sorted[offsets[keys[members[m]]]++] = members[m];
        // Each offset has moved on to the start of the next key.
        for (Index k = last - 1; k > first; --k)
            offsets[k] = offsets[k - 1];
        offsets[first] = begin;
    }
};

}  // namespace

std::int64_t exclusive_scan(Execution const& execution, std::span<std::int32_t> counts)
{
    auto const n = static_cast<Index>(counts.size());
    if (is_small(execution, n)) return exclusive_scan(counts);
    counts.back() = 0;
    std::vector<std::int32_t> sums(static_cast<std::size_t>(blocks_of(n)) + 1);
    for_each(execution, blocks_of(n),
             [data = counts.data(), sum = sums.data(), n](Index b)
             {
                 for (Index i = b * block; i < std::min(n, (b + 1) * block); ++i)
                     sum[b] += data[i];
             });
    exclusive_scan(sums);
    for_each(execution, blocks_of(n),
             [data = counts.data(), sum = sums.data(), n](Index b)
             {
                 std::int32_t at = sum[b];
                 for (Index i = b * block; i < std::min(n, (b + 1) * block); ++i)
                     at += std::exchange(data[i], at);
             });
    return counts.back();
}

void group_by_key(Execution const& execution, std::span<std::int32_t const> keys, std::int64_t n_keys, Groups& groups)
{
    auto const n = static_cast<Index>(keys.size());
    if (is_small(execution, n)) return group_by_key(keys, n_keys, groups);
    Index const blocks = blocks_of(n);
    int const shift = shift_for(n_keys);
    Buffer<std::int32_t> places(most_buckets * blocks + 1), members(n);
    groups.offsets.resize(n_keys + 1);
    groups.members.resize(n);

    BucketKernel kernel{{keys.data(), n}, shift, blocks, places.view().data, nullptr};
    for_each(execution, blocks, kernel);
    exclusive_scan(places.host());
    kernel.members = members.view().data;
    for_each(execution, blocks, kernel);
    for_each(execution, most_buckets,
             KeyKernel{keys.data(), shift, blocks, n_keys, places.view().data, members.view().data,
                       groups.offsets.view().data, groups.members.view().data});
    groups.offsets[n_keys] = static_cast<std::int32_t>(n);
}

}  // namespace gimdem::exec

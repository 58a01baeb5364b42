// SPDX-License-Identifier: BSD-3-Clause
/// Scan and stable counting sort: the building blocks of every list of lists (offsets + members).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exec/Buffer.hpp"
#include "exec/ForEach.hpp"

namespace gimdem::exec
{

/// counts[0..n-1] -> offsets in place, counts[n] = total. `counts` has n + 1 entries, the last one ignored on entry.
/// Returns the total.
inline std::int64_t exclusive_scan(std::span<std::int32_t> counts)
{
    std::int64_t total = 0;
    for (std::int32_t& entry : counts)
    {
        std::int32_t const count = entry;
        entry = static_cast<std::int32_t>(total);
        total += count;
    }
    return counts.empty() ? 0 : counts.back();
}

/// The same on all threads.
std::int64_t exclusive_scan(Execution const& execution, std::span<std::int32_t> counts);

/// Members grouped by key, in rising order within a key (stable): members of key k are
/// members[offsets[k]] ... members[offsets[k + 1] - 1].
struct Groups
{
    Buffer<std::int32_t> offsets;  ///< shape=(n_keys + 1,)
    Buffer<std::int32_t> members;  ///< shape=(n_members,)
};

/// Group 0..keys.size()-1 by keys[i] in [0, n_keys).
void group_by_key(std::span<std::int32_t const> keys, std::int64_t n_keys, Groups& groups);

/// The same on all threads.
void group_by_key(Execution const& execution, std::span<std::int32_t const> keys, std::int64_t n_keys, Groups& groups);

}  // namespace gimdem::exec

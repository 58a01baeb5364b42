// SPDX-License-Identifier: BSD-3-Clause
#include "exec/Sort.hpp"

#include <algorithm>

namespace gimdem::exec
{

void group_by_key(std::span<std::int32_t const> keys, std::int64_t n_keys, Groups& groups)
{
    groups.offsets.resize(n_keys + 1);
    groups.members.resize(static_cast<Index>(keys.size()));
    auto const offsets = groups.offsets.host();
    std::fill(offsets.begin(), offsets.end(), 0);
    for (std::int32_t const key : keys)
        ++offsets[static_cast<std::size_t>(key)];
    exclusive_scan(offsets);

    // offsets[k] serves as the write position of key k, which leaves it at the start of key k + 1: shift back.
    auto const members = groups.members.host();
    for (std::size_t i = 0; i < keys.size(); ++i)
        members[static_cast<std::size_t>(offsets[static_cast<std::size_t>(keys[i])]++)] = static_cast<std::int32_t>(i);
    for (std::size_t k = offsets.size() - 1; k > 0; --k)
        offsets[k] = offsets[k - 1];
    offsets[0] = 0;
}

}  // namespace gimdem::exec

// SPDX-License-Identifier: BSD-3-Clause
/// Memory that a benchmark holds.
#pragma once

#include <malloc.h>

#include <cstddef>

namespace gimdem::benchmark
{

/// At present, what it gave back excluded [B].
inline std::size_t memory_in_use()
{
    struct mallinfo2 const all = mallinfo2();
    return all.uordblks + all.hblkhd;  // small blocks, and those with pages of their own
}

}  // namespace gimdem::benchmark

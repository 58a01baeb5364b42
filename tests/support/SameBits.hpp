// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>

#include "exec/Buffer.hpp"

namespace gimdem::test
{

/// Whether two arrays are of one length and hold the same bits.
template <class T>
bool same_bits(exec::Buffer<T> const& a, exec::Buffer<T> const& b)
{
    return a.size() == b.size() &&
           (a.size() == 0 || std::memcmp(a.host().data(), b.host().data(), a.host().size_bytes()) == 0);
}

}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// What reductions on a device take and how they combine it.
#pragma once

#include <cstdint>

#include "exec/Vector.hpp"

namespace gimdem
{

template <class T>
struct Add
{
    GIMDEM_HD T identity() const { return T{}; }
    GIMDEM_HD T operator()(T const& a, T const& b) const { return a + b; }
};

/// Of numbers that are not negative.
struct Highest
{
    GIMDEM_HD std::int32_t identity() const { return 0; }
    GIMDEM_HD std::int32_t operator()(std::int32_t a, std::int32_t b) const { return a < b ? b : a; }
};

/// The entries of an array, whatever its type, as T.
template <class T, class Stored = T>
struct EntryOf
{
    Stored const* values;
    GIMDEM_HD T operator()(std::int64_t i) const { return static_cast<T>(values[i]); }
};

}  // namespace gimdem

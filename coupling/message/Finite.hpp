// SPDX-License-Identifier: BSD-3-Clause
/// Search for NaN and infinity.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

#include "gimdem/coupling/Span.hpp"

namespace gimdem::coupling::message
{

/// True if no value is NaN or infinite. Integer arithmetic without a branch: the compiler makes vector code of it.
inline bool all_finite(Span<double const> values)
{
    std::uint64_t constexpr exponent = 0x7ff0'0000'0000'0000;
    std::uint64_t bad = 0;
    for (double const value : values)
    {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof(bits));
        // All exponent bits set: the sum carries into the top bit once the sign is gone.
        bad |= (bits & exponent) + (std::uint64_t{1} << 52);
    }
    return (bad >> 63) == 0;
}

/// Copies the values and looks at them in one pass. False if one is NaN or infinite.
inline bool copy_finite(Span<double const> values, double* to)
{
    std::uint64_t constexpr exponent = 0x7ff0'0000'0000'0000;
    std::uint64_t bad = 0;
    std::size_t const size = values.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &values[i], sizeof(bits));
        bad |= (bits & exponent) + (std::uint64_t{1} << 52);
        to[i] = values[i];
    }
    return (bad >> 63) == 0;
}

/// Position of the first NaN or infinity.
inline std::optional<std::size_t> first_not_finite(Span<double const> values)
{
    if (all_finite(values)) return std::nullopt;
    std::size_t i = 0;
    while (std::isfinite(values[i]))
        ++i;
    return i;
}

}  // namespace gimdem::coupling::message

// SPDX-License-Identifier: BSD-3-Clause
/// Search for NaN and infinity.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

#include "gimdem/coupling/Span.hpp"

namespace gimdem::coupling::message
{

/// The top bit is set if the value is NaN or infinite; the others are anything.
inline std::uint64_t not_finite(double value)
{
    std::uint64_t constexpr exponent = 0x7ff0'0000'0000'0000;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    // All exponent bits set: the sum carries into the top bit once the sign is gone.
    return (bits & exponent) + (std::uint64_t{1} << 52);
}

/// True if no value is NaN or infinite. Integer arithmetic without a branch: the compiler makes vector code of it.
inline bool all_finite(Span<double const> values)
{
    std::uint64_t bad = 0;
    for (double const value : values)
        bad |= not_finite(value);
    return (bad >> 63) == 0;
}

/// Copies the values and looks at them in one pass. False if one is NaN or infinite.
inline bool copy_finite(Span<double const> values, double* to)
{
    std::uint64_t bad = 0;
    std::size_t const size = values.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        bad |= not_finite(values[i]);
        to[i] = values[i];
    }
    return (bad >> 63) == 0;
}

/// The same from float to double.
inline bool copy_finite(Span<float const> values, double* to)
{
    std::uint64_t bad = 0;
    std::size_t const size = values.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        to[i] = static_cast<double>(values[i]);
        bad |= not_finite(to[i]);
    }
    return (bad >> 63) == 0;
}

/// The same from double to float, rounded to nearest: within 2^-24 of a number's magnitude for 2^-126 and more of it.
/// False also for a number beyond the largest float.
inline bool copy_finite(Span<double const> values, float* to)
{
    std::uint32_t constexpr exponent = 0x7f80'0000;
    std::uint32_t bad = 0;
    std::size_t const size = values.size();
    for (std::size_t i = 0; i < size; ++i)
    {
        to[i] = static_cast<float>(values[i]);
        std::uint32_t bits = 0;
        std::memcpy(&bits, &to[i], sizeof(bits));
        bad |= (bits & exponent) + (std::uint32_t{1} << 23);
    }
    return (bad >> 31) == 0;
}

/// The same past the caches, for memory that another processor reads next and that this one has not seen for a step:
/// half the time, because what is overwritten is not fetched first. `to` lies at a multiple of 16 bytes.
inline bool stream_finite(Span<double const> values, double* to)
{
#ifdef __SSE2__
    std::uint64_t bad = 0;
    std::size_t const pairs = values.size() / 2;
    for (std::size_t i = 0; i < 2 * pairs; i += 2)
    {
        bad |= not_finite(values[i]) | not_finite(values[i + 1]);
        _mm_stream_pd(to + i, _mm_loadu_pd(values.data() + i));
    }
    if (values.size() % 2 != 0) bad |= not_finite(to[2 * pairs] = values[2 * pairs]);
    _mm_sfence();  // before the reader is told
    return (bad >> 63) == 0;
#else
    return copy_finite(values, to);
#endif
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

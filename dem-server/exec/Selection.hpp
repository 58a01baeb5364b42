// SPDX-License-Identifier: BSD-3-Clause
/// Some lanes of eight: which, and how to keep those alone.
#pragma once

#include <cstdint>
#include <cstring>

#include "exec/Octet.hpp"

namespace gimdem::exec
{

/// Bit n is lane n.
using LaneBits = std::uint32_t;
inline constexpr LaneBits all_lanes = (1u << octet) - 1;

inline LaneBits greater_lanes(Octet const& a, Octet const& b)
{
#ifdef __AVX512F__
    return _mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ);
#else
    LaneBits bits = 0;
    for (int lane = 0; lane < octet; ++lane)
        bits |= LaneBits(a[lane] > b[lane]) << lane;
    return bits;
#endif
}

/// Writes the chosen lanes one after the other; what follows them, up to eight numbers in all, is overwritten.
inline void keep(LaneBits chosen, Octet const& from, double* to)
{
#ifdef __AVX512F__
    _mm512_storeu_pd(to, _mm512_maskz_compress_pd(static_cast<__mmask8>(chosen), from.v));
#else
    for (int lane = 0; lane < octet; ++lane)
        if ((chosen >> lane & 1) != 0) *to++ = from[lane];
#endif
}
inline void keep(LaneBits chosen, std::int32_t const* from, std::int32_t* to)
{
#ifdef __AVX512VL__
    __m256i const all = _mm256_loadu_si256(reinterpret_cast<__m256i const*>(from));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_maskz_compress_epi32(static_cast<__mmask8>(chosen), all));
#else
    for (int lane = 0; lane < octet; ++lane)
        if ((chosen >> lane & 1) != 0) *to++ = from[lane];
#endif
}

/// Reads the first `count` lanes, up to all, and nothing behind them; the others are 0.
inline Octet load_first(double const* from, int count)
{
#ifdef __AVX512F__
    return {_mm512_maskz_loadu_pd(static_cast<__mmask8>((1u << count) - 1), from)};
#else
    Octet out = Octet::Constant(0);
    for (int lane = 0; lane < count; ++lane)
        out[lane] = from[lane];
    return out;
#endif
}

/// Writes the first `count` lanes, up to all, and nothing behind them.
inline void store_first(Octet const& from, int count, double* to)
{
#ifdef __AVX512F__
    _mm512_mask_storeu_pd(to, static_cast<__mmask8>((1u << count) - 1), from.v);
#else
    for (int lane = 0; lane < count; ++lane)
        to[lane] = from[lane];
#endif
}

/// Halves of the lanes are added until one is left: always in this order.
inline double sum_of_lanes(Octet const& x)
{
    return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

/// Lanes whose number is at least `low`.
inline LaneBits at_least_lanes(std::int32_t const* values, std::int32_t low)
{
#ifdef __AVX512VL__
    __m256i const all = _mm256_loadu_si256(reinterpret_cast<__m256i const*>(values));
    return _mm256_cmpge_epi32_mask(all, _mm256_set1_epi32(low));
#else
    LaneBits bits = 0;
    for (int lane = 0; lane < octet; ++lane)
        bits |= LaneBits(values[lane] >= low) << lane;
    return bits;
#endif
}
/// Lanes whose number is another one.
inline LaneBits other_lanes(std::uint16_t const* values, std::uint16_t than)
{
    // With both sanitizers g++ 12 stores the eight bits of the mask and reads thirty-two.
#if defined(__AVX512VL__) && defined(__AVX512BW__) && !defined(__SANITIZE_ADDRESS__)
    __m128i const all = _mm_loadu_si128(reinterpret_cast<__m128i const*>(values));
    return _mm_cmpneq_epi16_mask(all, _mm_set1_epi16(static_cast<short>(than)));
#else
    LaneBits bits = 0;
    for (int lane = 0; lane < octet; ++lane)
        bits |= LaneBits(values[lane] != than) << lane;
    return bits;
#endif
}

/// Numbers the chosen lanes from `from` on; all others get -1.
inline void number(LaneBits chosen, std::int32_t from, std::int32_t* to)
{
#ifdef __AVX512VL__
    __m256i const numbers = _mm256_add_epi32(_mm256_set1_epi32(from), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_mask_expand_epi32(_mm256_set1_epi32(-1), static_cast<__mmask8>(chosen), numbers));
#else
    for (int lane = 0; lane < octet; ++lane)
        to[lane] = (chosen >> lane & 1) != 0 ? from++ : -1;
#endif
}

}  // namespace gimdem::exec

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

/// Eight flags of one byte each, 0 or 1, that lie one after the other.
struct EightFlags
{
    std::uint64_t bytes;

    static EightFlags load(std::uint8_t const* from)
    {
        EightFlags out;
        std::memcpy(&out.bytes, from, sizeof out.bytes);
        return out;
    }
    static EightFlags of(LaneBits bits)
    {
#ifdef __BMI2__
        return {_pdep_u64(bits, 0x0101010101010101)};
#else
        std::uint8_t flags[octet];
        for (int lane = 0; lane < octet; ++lane)
            flags[lane] = bits >> lane & 1;
        return load(flags);
#endif
    }
    void store(std::uint8_t* to) const { std::memcpy(to, &bytes, sizeof bytes); }
};

}  // namespace gimdem::exec

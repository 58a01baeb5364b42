// SPDX-License-Identifier: BSD-3-Clause
/// Sixteen numbers of single precision: as wide a register as an Octet. What is stored is double and comes in octets,
/// so the two meet in memory: an octet fills one half of a hexadecad.
#pragma once

#include <cstring>

#include "exec/Octet.hpp"
#include "exec/Selection.hpp"

namespace gimdem::exec
{

using Hexadecad = Pack<float, 16>;

namespace detail
{
using EightSingles = float __attribute__((vector_size(32)));
}

/// Eight numbers that lie one after the other, in the precision of the memory.
inline Octet load_eight(double const* from)
{
    Octet out;
    std::memcpy(&out.v, from, sizeof out.v);
    return out;
}
inline Octet load_eight(float const* from)
{
    detail::EightSingles single;
    std::memcpy(&single, from, sizeof single);
    return {__builtin_convertvector(single, Octet::Vector)};
}
inline void store_eight(Octet const& from, double* to)
{
    std::memcpy(to, &from.v, sizeof from.v);
}
inline void store_eight(Octet const& from, float* to)
{
    auto const single = __builtin_convertvector(from.v, detail::EightSingles);
    std::memcpy(to, &single, sizeof single);
}

/// Writes the chosen lanes one after the other, rounded to single; see Selection.hpp.
inline void keep(LaneBits chosen, Octet const& from, float* to)
{
#ifdef __AVX512VL__
    _mm256_storeu_ps(to, _mm256_maskz_compress_ps(static_cast<__mmask8>(chosen), _mm512_cvtpd_ps(from.v)));
#else
    for (int lane = 0; lane < octet; ++lane)
        if ((chosen >> lane & 1) != 0) *to++ = static_cast<float>(from[lane]);
#endif
}

}  // namespace gimdem::exec

// SPDX-License-Identifier: BSD-3-Clause
/// Special functions of many numbers at once: the SLEEF library's vector functions on the host where there are such,
/// the scalar ones elsewhere. A number's result does not depend on its neighbours.
#pragma once

#include <cmath>

#include "exec/HostDevice.hpp"

#if defined(GIMDEM_SLEEF) && !defined(__CUDA_ARCH__) && (defined(__AVX512F__) || defined(__AVX2__))
#include <immintrin.h>
#include <sleef.h>
#define GIMDEM_VECTOR_MATH
#endif

namespace gimdem::exec
{

/// Arrays handed to erfc_many have room for a multiple of this many numbers.
inline constexpr int vector_width = 8;

/// x[i] <- erfc(x[i]) for i < count, to 1.5 units in the last place. Beyond `count`, up to the next multiple of
/// vector_width, entries are overwritten.
GIMDEM_HD inline void erfc_many(double* x, int count)
{
#ifdef GIMDEM_VECTOR_MATH
    for (int i = count; i % vector_width != 0; ++i)
        x[i] = 0;
    for (int i = 0; i < count; i += vector_width)
    {
#ifdef __AVX512F__
        _mm512_storeu_pd(x + i, Sleef_erfcd8_u15(_mm512_loadu_pd(x + i)));
#else
        _mm256_storeu_pd(x + i, Sleef_erfcd4_u15(_mm256_loadu_pd(x + i)));
        _mm256_storeu_pd(x + i + 4, Sleef_erfcd4_u15(_mm256_loadu_pd(x + i + 4)));
#endif
    }
#else
    for (int i = 0; i < count; ++i)
        x[i] = std::erfc(x[i]);
#endif
}

}  // namespace gimdem::exec

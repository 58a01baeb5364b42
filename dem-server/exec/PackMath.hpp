// SPDX-License-Identifier: BSD-3-Clause
/// What the laws compute with packs beyond + - * /: the same names as for one number, see exec/VectorMath.hpp.
///
/// Where the processor has AVX-512, roots are its estimate of 14 bits improved by one step of fourth order, which needs
/// no division and is within two units in the last place; elsewhere they are the compiler's.
#pragma once

#include <cmath>
#include <limits>

#include "exec/Pack.hpp"
#include "exec/Vector.hpp"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace gimdem::exec
{

template <int n>
inline constexpr bool is_single<Pack<float, n>> = true;

/// Below it a root is taken of this instead: the square root of 0 is as good as 0.
template <class Number>
inline constexpr Number least = Number(1024) * std::numeric_limits<Number>::min();

template <class Number, int n>
Pack<Number, n> at_least(Number low, Pack<Number, n> const& x)
{
    return low > x.v ? low - typename Pack<Number, n>::Vector{} : x.v;  // a NaN stays one
}

/// c + a b and c - a b, rounded once where the processor can.
template <class Number, int n>
Pack<Number, n> plus_product(Pack<Number, n> const& c, Pack<Number, n> const& a, Pack<Number, n> const& b)
{
    return c.v + a.v * b.v;
}
template <class Number, int n>
Pack<Number, n> minus_product(Pack<Number, n> const& c, Pack<Number, n> const& a, Pack<Number, n> const& b)
{
    return c.v - a.v * b.v;
}

/// 1 / sqrt x of x >= least.
template <class Number, int n>
Pack<Number, n> per_root_of_positive(Pack<Number, n> const& x)
{
    Pack<Number, n> out;
    for (int lane = 0; lane < n; ++lane)
        out[lane] = 1 / std::sqrt(x[lane]);
    return out;
}

#ifdef __AVX512F__
inline Pack<double, 8> plus_product(Pack<double, 8> const& c, Pack<double, 8> const& a, Pack<double, 8> const& b)
{
    return {_mm512_fmadd_pd(a.v, b.v, c.v)};
}
inline Pack<double, 8> minus_product(Pack<double, 8> const& c, Pack<double, 8> const& a, Pack<double, 8> const& b)
{
    return {_mm512_fnmadd_pd(a.v, b.v, c.v)};
}
inline Pack<float, 16> plus_product(Pack<float, 16> const& c, Pack<float, 16> const& a, Pack<float, 16> const& b)
{
    return {_mm512_fmadd_ps(a.v, b.v, c.v)};
}
inline Pack<float, 16> minus_product(Pack<float, 16> const& c, Pack<float, 16> const& a, Pack<float, 16> const& b)
{
    return {_mm512_fnmadd_ps(a.v, b.v, c.v)};
}

inline Pack<double, 8> magnitude(Pack<double, 8> const& x)
{
    return {_mm512_abs_pd(x.v)};
}
inline Pack<float, 16> magnitude(Pack<float, 16> const& x)
{
    return {_mm512_abs_ps(x.v)};
}

/// With y the estimate and h = 1 - x y^2: 1 / sqrt x = y (1 - h)^(-1/2) = y (1 + h/2 + 3 h^2/8 + 5 h^3/16 + ...).
inline Pack<double, 8> per_root_of_positive(Pack<double, 8> const& x)
{
    using Real = Pack<double, 8>;
    Real const y = {_mm512_rsqrt14_pd(x.v)};
    Real const h = minus_product(Real::Constant(1), Real(x * y), y);
    Real const series =
        plus_product(Real::Constant(0.5), plus_product(Real::Constant(0.375), Real::Constant(0.3125), h), h);
    return plus_product(y, Real(y * h), series);
}
inline Pack<float, 16> per_root_of_positive(Pack<float, 16> const& x)
{
    using Real = Pack<float, 16>;
    Real const y = {_mm512_rsqrt14_ps(x.v)};
    Real const h = minus_product(Real::Constant(1), Real(x * y), y);
    // Without the second term the result would be too small by 1e-8 always, which adds up over many steps.
    return plus_product(y, Real(y * h), plus_product(Real::Constant(0.5), Real::Constant(0.375), h));
}
#endif

template <class Number, int n>
Pack<Number, n> magnitude(Pack<Number, n> const& x)
{
    return x.v < 0 ? -x.v : x.v;
}
/// 1 / sqrt x for x > 0.
template <class Number, int n>
Pack<Number, n> per_root(Pack<Number, n> const& x)
{
    return per_root_of_positive(at_least(least<Number>, x));
}
/// sqrt x for x >= 0.
template <class Number, int n>
Pack<Number, n> root(Pack<Number, n> const& x)
{
    Pack<Number, n> const positive = at_least(least<Number>, x);
    return positive * per_root_of_positive(positive);
}
/// sqrt(a / b) for a, b >= 0, and 1 where both are 0.
template <class Number, int n>
Pack<Number, n> root_of_ratio(Pack<Number, n> const& a, Pack<Number, n> const& b)
{
    return root(a) * per_root(b);
}

}  // namespace gimdem::exec

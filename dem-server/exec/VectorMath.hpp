// SPDX-License-Identifier: BSD-3-Clause
/// erfc of many numbers at once. A number's result does not depend on its neighbours.
///
/// erfc(x) = exp(-x^2) h(x) for x >= 0, with h expanded in Chebyshev polynomials of u = 2 t - 1, t = 4 / (4 + x). On
/// the device the library's erfc.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <iterator>
#include <type_traits>

#include "exec/HostDevice.hpp"

namespace gimdem::exec
{

/// Chebyshev coefficients of exp(x^2) erfc(x) in u, the first one halved; computed with 50 digits. The first one left
/// out is 2e-18.
inline constexpr double erfcx_coefficients[] = {
    2.98101793693657604e-1,   4.29086441255805367e-1,   1.80272565687710565e-1,  6.52375244973489915e-2,
    2.03672565767448646e-2,   5.44908706645900758e-3,   1.22785153726067553e-3,  2.24697942187730494e-4,
    3.06854311309895153e-5,   2.31782349994685337e-6,   -1.4628356484727578e-7,  -6.92783051874894925e-8,
    -6.88311076336284638e-9,  6.85848914944545031e-10,  2.4593734989496684e-10,  7.81490917402809597e-12,
    -5.88939473381726269e-12, -6.86923043856799338e-13, 1.2550492580108261e-13,  2.82325095027981509e-14,
    -2.60316463431754324e-15, -1.02499601950092352e-15, 5.72841468125684976e-17, 3.69287512932721499e-17,
    -1.57255072964202748e-18};

/// Numbers taken together; Eigen turns them into vector instructions, several at once to hide their latency.
inline constexpr int vector_width = 32;
using Lanes = Eigen::Array<double, vector_width, 1>;

// The few operations that a law needs to be written once for a number and for many (an Eigen array).
GIMDEM_HD inline double choose(bool condition, double yes, double no)
{
    return condition ? yes : no;
}
GIMDEM_HD inline double magnitude(double x)
{
    return std::fabs(x);
}
/// The same number in every lane.
template <class Real>
GIMDEM_HD Real broadcast(double x)
{
    if constexpr (std::is_floating_point_v<Real>)
        return x;
    else
        return Real::Constant(x);
}
GIMDEM_HD inline bool greater(double a, double b)
{
    return a > b;
}
GIMDEM_HD inline double root(double x)
{
    return std::sqrt(x);
}
/// 1 / sqrt x.
GIMDEM_HD inline double per_root(double x)
{
    return 1 / std::sqrt(x);
}
/// sqrt(a / b) for a, b >= 0, and 1 where both are 0.
GIMDEM_HD inline double root_of_ratio(double a, double b)
{
    constexpr double tiny = 1e-300;
    return std::sqrt((a + tiny) / (b + tiny));
}
GIMDEM_HD inline double exponential(double x)
{
    return std::exp(x);
}
GIMDEM_HD inline double logarithm(double x)
{
    return std::log(x);
}
template <class Condition, class Real>
Real choose(Condition const& condition, Eigen::ArrayBase<Real> const& yes, Eigen::ArrayBase<Real> const& no)
{
    return condition.select(yes, no);
}
template <class Real>
Real magnitude(Eigen::ArrayBase<Real> const& x)
{
    return x.abs();
}
template <class Real>
Real root(Eigen::ArrayBase<Real> const& x)
{
    return x.sqrt();
}
template <class Real>
Real exponential(Eigen::ArrayBase<Real> const& x)
{
    return x.exp();
}
template <class Real>
Real logarithm(Eigen::ArrayBase<Real> const& x)
{
    return x.log();
}

/// x, but no less than `floor`.
template <class Real, class Floor>
GIMDEM_HD Real no_less(Real const& x, Floor const& floor)
{
    Real const bound = [&]
    {
        if constexpr (std::is_same_v<Real, Floor>)
            return floor;
        else
            return broadcast<Real>(floor);
    }();
    return choose(greater(x, bound), x, bound);
}

// g++ 12 takes the deliberately undefined operand of its own AVX-512 intrinsics for a mistake of ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
inline Lanes complementary_error(Lanes const& x)
{
    Lanes const a = x.abs();
    Lanes const u2 = 2 * (8 / (4 + a) - 1);
    // Clenshaw's recurrence, from the last coefficient down to the second.
    Lanes b1 = Lanes::Zero(), b2 = Lanes::Zero();
    for (int j = static_cast<int>(std::size(erfcx_coefficients)) - 1; j > 0; --j)
    {
        Lanes const b = u2 * b1 - b2 + erfcx_coefficients[j];
        b2 = b1;
        b1 = b;
    }
    Lanes const tail = (-a * a).exp() * (0.5 * u2 * b1 - b2 + erfcx_coefficients[0]);
    return (x < 0).select(2 - tail, tail);
}
#pragma GCC diagnostic pop

/// x[i] <- erfc(x[i]) for i < count; relative error below 2e-15 for |x| < 2 and x^2 * 5e-16 beyond. The array must have
/// room for a multiple of vector_width numbers; what lies past `count` is overwritten.
inline void erfc_many(double* x, int count)
{
    for (int i = count; i % vector_width != 0; ++i)
        x[i] = 0;
    for (int i = 0; i < count; i += vector_width)
        Eigen::Map<Lanes>(x + i) = complementary_error(Eigen::Map<Lanes>(x + i));
}

}  // namespace gimdem::exec

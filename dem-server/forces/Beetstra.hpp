// SPDX-License-Identifier: BSD-3-Clause
/// Drag of Beetstra, van der Hoef and Kuipers, theory.md (D.17).
#pragma once

#include <type_traits>

#include "exec/Octet.hpp"
#include "exec/VectorMath.hpp"

namespace gimdem
{

/// Normalised drag force F(solid fraction, Re) of a sphere in a monodisperse suspension (paper Eq. 10):
///
///   F = 10 s / e^2 + e^2 (1 + 1.5 sqrt s) + 0.413 Re / (24 e^2) (1/e + 3 s e + 8.4 Re^-0.343) / (1 + 10^(3 s) Re^-(1 +
///   4 s)/2)
///
/// with e = 1 - s. The last term is Re^(1 - 0.343) ... and tends to 0 with Re; it is written with the singular powers
/// multiplied out, so that Re = 0 needs no special case beyond the logarithm. Real is double, or an Eigen array of
/// many.
template <class Real>
requires(!std::is_integral_v<Real>) GIMDEM_HD Real beetstra_factor(Real const& void_fraction, Real const& reynolds)
{
    Real const e = void_fraction;
    Real const s = 1 - e;
    Real const creeping = 10 * s / (e * e) + e * e * (1 + 1.5 * exec::root(s));

    // Re A / (1 + B Re^-q) = Re^(1 + q) A / (Re^q + B): no negative power of Re is left over.
    auto const flows = exec::greater(reynolds, exec::broadcast<Real>(0));
    Real const log_re = exec::logarithm(exec::choose(flows, reynolds, exec::broadcast<Real>(1)));
    Real const re_q = exec::exponential(Real((1 + 4 * s) / 2 * log_re));
    Real const numerator = (1 / e + 3 * s * e) * reynolds + 8.4 * exec::exponential(Real(0.657 * log_re));
    Real const damping = exec::exponential(Real(3 * 2.30258509299404568402 * s));
    Real const inertial = 0.413 / (24 * e * e) * numerator * re_q / (re_q + damping);
    return creeping + exec::choose(flows, inertial, exec::broadcast<Real>(0));
}

GIMDEM_HD inline double beetstra_factor(double void_fraction, double reynolds)
{
    return beetstra_factor<double>(void_fraction, reynolds);
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Drag of Beetstra, van der Hoef and Kuipers, theory.md (D.17).
#pragma once

#include <cmath>

#include "exec/HostDevice.hpp"

namespace gimdem
{

/// Normalised drag force F(solid fraction, Re) of a sphere in a monodisperse suspension (paper Eq. 10):
///
///   F = 10 s / e^2 + e^2 (1 + 1.5 sqrt s) + 0.413 Re / (24 e^2) (1/e + 3 s e + 8.4 Re^-0.343) / (1 + 10^(3 s) Re^-(1 +
///   4 s)/2)
///
/// with e = 1 - s. The last term is Re^(1 - 0.343) ... and tends to 0 with Re; it is written with the singular powers
/// multiplied out, so that Re = 0 needs no special case beyond the logarithm.
GIMDEM_HD inline double beetstra_factor(double void_fraction, double reynolds)
{
    double const e = void_fraction;
    double const s = 1 - e;
    double const creeping = 10 * s / (e * e) + e * e * (1 + 1.5 * std::sqrt(s));
    if (!(reynolds > 0)) return creeping;

    // Re A / (1 + B Re^-q) = Re^(1 + q) A / (Re^q + B): no negative power of Re is left over.
    double const log_re = std::log(reynolds);
    double const q = (1 + 4 * s) / 2;
    double const re_q = std::exp(q * log_re);
    double const numerator = (1 / e + 3 * s * e) * reynolds + 8.4 * std::exp(0.657 * log_re);
    double const damping = std::exp(3 * s * 2.30258509299404568402);
    return creeping + 0.413 / (24 * e * e) * numerator * re_q / (re_q + damping);
}

}  // namespace gimdem

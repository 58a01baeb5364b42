// SPDX-License-Identifier: BSD-3-Clause
/// What Figures 3 to 8 of the paper of the Gaussian Integral Method show: one particle and one spherical cell,
/// theory.md (G.4)-(G.7), (G.15)-(G.18). Lengths are in radii of the particle, so V_p counts as 1.
#pragma once

#include <cmath>
#include <utility>

#include "mapping/GaussianIntegral.hpp"

namespace gimdem::test
{

/// I / V_p at the distance mu = r_c + psi r_p, psi = -1 ... 1: from inside the cell's sphere to outside, touching it.
inline double shared_volume(double volume_ratio, double coefficient, double psi)
{
    return GaussianIntegral{1.0, std::log(volume_ratio), coefficient}(std::cbrt(volume_ratio) + psi);
}

/// Part of a ball inside of a plane that its centre is psi radii outside of, (G.17).
inline double cap_inside(double psi)
{
    return (1 - psi) * (1 - psi) * (2 + psi) / 4;
}

/// Eq. 26 as it is printed.
inline double cap_as_printed(double psi)
{
    return (1 + psi) * (1 + psi) * (1 - (1 + psi) / 3) * 3 / 4;
}

/// Mean squared deviation of the shared volume from a cap over psi in [-1, 1], by the trapezoidal rule.
template <class Cap>
double deviation_from(Cap cap, double volume_ratio, double coefficient)
{
    int constexpr intervals = 400;
    double sum = 0;
    for (int i = 0; i <= intervals; ++i)
    {
        double const psi = 2.0 * i / intervals - 1;
        double const off = shared_volume(volume_ratio, coefficient, psi) - cap(psi);
        sum += (i == 0 || i == intervals ? 0.5 : 1.0) * off * off;
    }
    return sum / intervals;
}

/// The coefficient whose curve is nearest to the cap by least squares, (G.18): golden section between 0.2 and 0.9.
inline double best_coefficient(double volume_ratio)
{
    double const part = (std::sqrt(5.0) - 1) / 2;
    double low = 0.2, high = 0.9;
    while (high - low > 1e-9)
    {
        double const a = high - part * (high - low), b = low + part * (high - low);
        if (deviation_from(cap_inside, volume_ratio, a) < deviation_from(cap_inside, volume_ratio, b))
            high = b;
        else
            low = a;
    }
    return (low + high) / 2;
}

/// Factor and exponent of the power law c x^(-n) through the best coefficients at x = 2, 3 ... `last`, by least squares
/// of the logarithms: the trend line, Eq. 27.
inline std::pair<double, double> trend_line(int last)
{
    double n = 0, x1 = 0, x2 = 0, y1 = 0, xy = 0;
    for (int ratio = 2; ratio <= last; ++ratio)
    {
        double const x = std::log(ratio), y = std::log(best_coefficient(ratio));
        n += 1, x1 += x, x2 += x * x, y1 += y, xy += x * y;
    }
    double const slope = (n * xy - x1 * y1) / (n * x2 - x1 * x1);
    return {std::exp((y1 - slope * x1) / n), -slope};
}

/// The smallest coefficient with which a cell shares the whole of a particle that touches its sphere from inside,
/// (G.16).
inline double least_whole_coefficient(double volume_ratio)
{
    double const s = std::cbrt(volume_ratio);
    return std::sqrt((s - 1) / ((s + 1) * std::log(s))) / 2;
}

}  // namespace gimdem::test

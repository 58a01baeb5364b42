// SPDX-License-Identifier: BSD-3-Clause
/// The Gaussian Integral Method for one particle and one cell, theory.md (G.4)-(G.8).
#pragma once

#include <cmath>

#include "exec/HostDevice.hpp"

namespace gimdem
{

/// Tuned coefficient (G.7): phi = 0.579 (V_p / V_c)^0.132.
GIMDEM_HD inline double tuned_coefficient(double log_volume_ratio)  ///< ln(V_c / V_p)
{
    return 0.579 * std::exp(-0.132 * log_volume_ratio);
}

/// Shared integral I = int min(G_p, G_c) dx divided by V_p, for the Gaussians of (G.5) with sigma = phi r.
///
/// With s = sigma_c / sigma_p = (V_c / V_p)^(1/3), x in units of sigma_p and m = mu / sigma_p, the Gaussians cross
/// where (s^2 - 1) x^2 + 2 m x - m^2 - 4 s^2 ln s = 0, and between the roots the wider one is the lower. The right-hand
/// root is written as C / (B + sqrt(D)), the left-hand one as -(B + sqrt(D)) / A: neither cancels, and for s -> 1 the
/// right-hand root tends to m / 2, the single crossing of equal Gaussians, while the other one goes to infinity.
struct GaussianIntegral
{
    double radius;            ///< r_p [m]
    double log_volume_ratio;  ///< ln(V_c / V_p)
    double coefficient;       ///< phi [1]

    /// I / V_p for centre distance mu >= 0 [m]: in [0, max(1, V_c / V_p)].
    GIMDEM_HD double operator()(double distance) const
    {
        double const log_s = log_volume_ratio / 3;
        // Of two Gaussians the wider one is also the larger in volume: swap so that s >= 1, and undo at the end.
        bool const swapped = log_s < 0;
        double const s = std::exp(swapped ? -log_s : log_s);
        double const narrow_sigma = coefficient * radius * (swapped ? 1 / s : 1.0);
        double const m = distance / narrow_sigma;
        double const shared = shared_with_wider(s, swapped ? -log_s : log_s, m);
        return swapped ? shared * std::exp(log_volume_ratio) : shared;
    }

private:
    /// int min(g, s^3 g_wide) dx with g the standard normal density and g_wide that of N(m, s), s >= 1.
    GIMDEM_HD static double shared_with_wider(double s, double log_s, double m)
    {
        double const a = s * s - 1;
        double const c = m * m - 4 * s * s * log_s;
        double const discriminant = m * m + a * c;
        if (!(discriminant > 0)) return 1;  // the narrow one lies below everywhere, (G.6)
        double const root = std::sqrt(discriminant);
        double const right = c / (m + root);
        double const left = -(m + root) / a;  // -infinity for s = 1
        double const narrow_outside = upper_half(right) + upper_half(-left);
        double const wide_inside = upper_half((m - right) / s) - upper_half((m - left) / s);
        return narrow_outside + s * s * s * wide_inside;
    }

    /// int_z^inf of the standard normal density.
    GIMDEM_HD static double upper_half(double z) { return 0.5 * std::erfc(z * 0.70710678118654752440); }
};

}  // namespace gimdem

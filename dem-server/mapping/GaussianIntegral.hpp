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

/// The shared integral of two Gaussians as a sum of four tails, theory.md (G.6):
///
///   I / V_narrow = Q(z0) + Q(z1) + s^3 (Q(z2) - Q(z3)),   Q(z) = erfc(z / sqrt 2) / 2
struct Tails
{
    double x[4];          ///< z_k / sqrt 2; where the two do not cross, such that the sum is 1
    double cube;          ///< s^3, ratio of the larger to the smaller volume
    double in_particles;  ///< V_narrow / V_p

    /// I / V_p.
    GIMDEM_HD double sum() const
    {
        return in_particles * 0.5 * (std::erfc(x[0]) + std::erfc(x[1]) + cube * (std::erfc(x[2]) - std::erfc(x[3])));
    }
};

/// A particle and a cell, the numbers that (G.4) to (G.7) need of them.
struct ParticleAndCell
{
    double particle_radius;  ///< r_p [m]
    double radius_ratio;     ///< r_c / r_p = (V_c / V_p)^(1/3)
    double log_radius_ratio;
    double coefficient;  ///< phi [1]

    /// The tails at the centre distance mu >= 0 [m].
    ///
    /// Of two Gaussians the wider is also the larger in volume; s >= 1 is the ratio of their deviations and m the
    /// distance in deviations of the narrow one. The roots do not cancel, and for s = 1 the left one is at -infinity.
    /// Without crossing the narrow Gaussian lies below everywhere: its two tails meet at 0 and the wide one has no
    /// part.
    GIMDEM_HD Tails operator()(double mu) const
    {
        bool const cell_is_narrow = log_radius_ratio < 0;
        double const s = cell_is_narrow ? 1 / radius_ratio : radius_ratio;
        double const log_s = cell_is_narrow ? -log_radius_ratio : log_radius_ratio;
        double const cube = s * s * s;
        double const in_particles = cell_is_narrow ? 1 / cube : 1;
        double const narrow_radius = particle_radius * (cell_is_narrow ? radius_ratio : 1);
        double const m = mu / (coefficient * narrow_radius);

        double const a = s * s - 1;
        double const c = m * m - 4 * s * s * log_s;
        double const discriminant = m * m + a * c;
        if (!(discriminant > 0)) return {{0, 0, 0, 0}, cube, in_particles};
        double const sum = m + std::sqrt(discriminant);
        double const right = c / sum;
        double const left = -sum / a;
        double const h = 0.70710678118654752440;
        return {{h * right, -h * left, h * (m - right) / s, h * (m - left) / s}, cube, in_particles};
    }
};

/// I / V_p of one pair: in [0, min(1, V_c / V_p)].
struct GaussianIntegral
{
    double radius;            ///< r_p [m]
    double log_volume_ratio;  ///< ln(V_c / V_p)
    double coefficient;       ///< phi [1]

    GIMDEM_HD double operator()(double mu) const
    {
        double const log_ratio = log_volume_ratio / 3;
        return ParticleAndCell{radius, std::exp(log_ratio), log_ratio, coefficient}(mu).sum();
    }
};

}  // namespace gimdem

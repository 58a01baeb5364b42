// SPDX-License-Identifier: BSD-3-Clause
/// The Gaussian Integral Method for one particle and one cell, theory.md (G.4)-(G.8).
#pragma once

#include <cmath>

#include "exec/VectorMath.hpp"

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
///
/// The tails are apart from their sum so that many pairs can have their erfc taken at once. Real is double, or Lanes
/// for many pairs.
template <class Real>
struct TailArguments
{
    Real x[4];          ///< z_k / sqrt 2; where the two do not cross, such that the sum is 1
    Real cube;          ///< s^3, ratio of the larger to the smaller volume
    Real log_cube;      ///< its logarithm
    Real in_particles;  ///< V_narrow / V_p

    /// I / V_p from t_k = erfc(x[k]).
    GIMDEM_HD Real sum(Real const& t0, Real const& t1, Real const& t2, Real const& t3) const
    {
        return in_particles * 0.5 * (t0 + t1 + cube * (t2 - t3));
    }
};

/// A particle and a cell, the numbers that (G.4) to (G.7) need of them.
template <class Real>
struct ParticleAndCell
{
    double particle_radius;  ///< r_p [m]
    Real radius_ratio;       ///< r_c / r_p = (V_c / V_p)^(1/3)
    Real log_radius_ratio;
    Real coefficient;  ///< phi [1]

    /// Arguments of the tails at the centre distance mu >= 0 [m].
    ///
    /// Of two Gaussians the wider is also the larger in volume; s >= 1 is the ratio of their deviations and m the
    /// distance in deviations of the narrow one. The roots do not cancel, and for s = 1 the left one is at -infinity.
    /// Without crossing the narrow Gaussian lies below everywhere: its two tails meet at 0 and the wide one has no
    /// part.
    GIMDEM_HD TailArguments<Real> operator()(Real const& mu) const
    {
        using exec::choose;
        auto const cell_is_narrow = log_radius_ratio < 0;
        Real const s = choose(cell_is_narrow, Real(1 / radius_ratio), radius_ratio);
        Real const log_s = choose(cell_is_narrow, Real(-log_radius_ratio), log_radius_ratio);
        Real const cube = s * s * s;
        Real const narrow_radius = particle_radius * choose(cell_is_narrow, radius_ratio, Real(0 * s + 1));
        Real const m = mu / (coefficient * narrow_radius);

        Real const a = s * s - 1;
        Real const c = m * m - 4 * s * s * log_s;
        Real const discriminant = m * m + a * c;
        auto const crosses = discriminant > 0;
        Real const zero = 0 * s;
        Real const sum = m + exec::root(choose(crosses, discriminant, Real(zero + 1)));
        Real const right = c / sum;
        Real const left = -sum / a;
        double const h = 0.70710678118654752440;
        return {{choose(crosses, Real(h * right), zero), choose(crosses, Real(-h * left), zero),
                 choose(crosses, Real(h * (m - right) / s), zero), choose(crosses, Real(h * (m - left) / s), zero)},
                cube,
                Real(3 * log_s),
                choose(cell_is_narrow, Real(1 / cube), Real(zero + 1))};
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
        auto const tails = ParticleAndCell<double>{radius, std::exp(log_ratio), log_ratio, coefficient}(mu);
        return tails.sum(std::erfc(tails.x[0]), std::erfc(tails.x[1]), std::erfc(tails.x[2]), std::erfc(tails.x[3]));
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// The shared integral of one radius and one volume as what tables of it are made of, theory.md (G.11).
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mapping/GaussianIntegral.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// I / V_p over t, where mu^2 = narrow^2 (t^2 + crossing2).
struct TabulatedIntegral
{
    GaussianIntegral integral;
    double narrow;     ///< deviation of the narrower Gaussian [m]
    double crossing2;  ///< (mu / narrow)^2 where the two begin to cross: 4 (s^2 - 1) ln s

    /// fixed_coefficient: phi; 0: that of Eq. 27.
    TabulatedIntegral(double radius, double volume, double fixed_coefficient)
    {
        double const log_ratio = std::log(volume / sphere_volume(radius));
        double const log_s = std::abs(log_ratio) / 3;
        integral = {radius, log_ratio, fixed_coefficient > 0 ? fixed_coefficient : tuned_coefficient(log_ratio)};
        narrow = integral.coefficient * radius * std::exp(std::min(0.0, log_ratio / 3));
        crossing2 = 4 * std::expm1(2 * log_s) * log_s;
    }

    double operator()(double t) const { return integral(narrow * std::sqrt(t * t + crossing2)); }

    /// The t beyond which the integral is less than `nothing`.
    double end(double nothing) const
    {
        double low = 0, high = 1;
        while ((*this)(high) > nothing)
            high *= 2;
        while (high - low > 1e-3 * high)
            ((*this)((low + high) / 2) > nothing ? low : high) = (low + high) / 2;
        return high;
    }
};

/// Polynomials of `terms` coefficients through Chebyshev's points of [-1/2, 1/2].
template <int terms>
struct ChebyshevFit
{
    using Terms = Eigen::Matrix<long double, terms, 1>;

    static long double node(int k) { return std::cos(std::numbers::pi_v<long double> * (k + 0.5L) / terms) / 2; }

    /// Coefficients of the polynomial with these values at the nodes.
    static Terms coefficients(Terms const& values)
    {
        static Eigen::Matrix<long double, terms, terms> const from_values = powers().inverse();
        return from_values * values;
    }

    static long double value(Terms const& coefficients, long double u)
    {
        long double sum = 0;
        for (int j = terms - 1; j >= 0; --j)
            sum = sum * u + coefficients[j];
        return sum;
    }

private:
    static Eigen::Matrix<long double, terms, terms> powers()
    {
        Eigen::Matrix<long double, terms, terms> out;
        for (int k = 0; k < terms; ++k)
            for (int j = 0; j < terms; ++j)
                out(k, j) = std::pow(node(k), static_cast<long double>(j));
        return out;
    }
};

}  // namespace gimdem

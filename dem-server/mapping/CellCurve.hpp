// SPDX-License-Identifier: BSD-3-Clause
/// The shared integral of the Gaussian Integral Method of one cell for itself, where all cells are of different volumes
/// and the particles of few radii, theory.md (G.11a): polynomials looked up in registers, for eight particles at a
/// time.
#pragma once

#include "exec/SmallTable.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// One cell and one radius. With x = (mu^2 scale - offset)^(1/4), which is 0 where the Gaussians begin to cross and 8
/// where nothing is left, I / V_p is a polynomial of u = x - (i + 1/2) in each interval i <= x <= i + 1.
struct alignas(64) CellCurve
{
    static constexpr int degree = 13;  ///< odd
    static constexpr int intervals = exec::octet;
    /// x^4 beyond which the integral counts as nothing: just before x = 8, so that no rounding leads past it.
    static constexpr double end = 4095.9;

    double coefficients[degree + 1][intervals];  ///< of u^j
    Quad cell;                                   ///< centroid [m], w: volume [m^3]
    double scale;                                ///< [1/m^2]
    double offset;                               ///< [1]

    /// I / V_p of eight particles.
    exec::Octet operator()(exec::OctetOfQuads const& particles) const
    {
        using exec::Octet;
        using exec::plus_product;
        Octet const dx = particles.x - cell.x, dy = particles.y - cell.y, dz = particles.z - cell.z;
        Octet const mu2 = plus_product(plus_product(Octet(dx * dx), dy, dy), dz, dz);
        return at(plus_product(Octet::Constant(-offset), mu2, Octet::Constant(scale)));
    }

    /// I / V_p at eight places; what is below 0 counts as 0.
    exec::Octet at(exec::Octet const& x4) const
    {
        using exec::Octet;
        Octet const from_first = exec::root(exec::root(exec::at_least(0.0, x4))) - 0.5;
        exec::NearestWhole const interval(from_first);
        Octet const u = from_first - interval.value();
        // Even and odd powers apart: two chains of half the length.
        Octet const u2 = u * u;
        Octet even = interval.pick(coefficients[degree - 1]), odd = interval.pick(coefficients[degree]);
#pragma GCC unroll 16
        for (int j = degree - 3; j >= 0; j -= 2)
        {
            even = exec::plus_product(interval.pick(coefficients[j]), even, u2);
            odd = exec::plus_product(interval.pick(coefficients[j + 1]), odd, u2);
        }
        Octet const sum = exec::plus_product(even, odd, u);
        return choose(greater(Octet::Constant(end), x4), exec::at_least(0.0, sum), Octet::Constant(0));
    }
};

}  // namespace gimdem

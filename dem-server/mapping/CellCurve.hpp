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
    static constexpr int degree = 13;
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
        Octet const x4 = plus_product(Octet::Constant(-offset), mu2, Octet::Constant(scale));
        Octet const from_first = exec::root(exec::root(exec::at_least(0.0, x4))) - 0.5;
        exec::NearestWhole const interval(from_first);
        Octet const u = from_first - interval.value();
        Octet sum = interval.pick(coefficients[degree]);
#pragma GCC unroll 16
        for (int j = degree - 1; j >= 0; --j)
            sum = plus_product(interval.pick(coefficients[j]), sum, u);
        return choose(greater(Octet::Constant(end), x4), exec::at_least(0.0, sum), Octet::Constant(0));
    }
};

}  // namespace gimdem

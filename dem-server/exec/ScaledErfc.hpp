// SPDX-License-Identifier: BSD-3-Clause
/// exp(x^2) erfc(x) of eight numbers at once. A number's result does not depend on its neighbours.
///
/// A polynomial in u = 2 t - 1, t = 4 / (4 + x), which maps x >= 0 onto [-1, 1]: the Chebyshev series there, cut where
/// its terms are below 1e-16, as powers of u, which are as well conditioned (their coefficients add up to 1.0).
#pragma once

#include <iterator>

#include "exec/PackMath.hpp"

namespace gimdem::exec
{

/// Coefficients of 1, u, u^2, ...; computed with 60 digits.
inline constexpr double scaled_erfc_coefficients[] = {
    0.136999457625061449,      0.259068048760172523,    0.218719678918250552,      0.164257816697230708,
    0.108963177399482653,      0.0631078156417945764,   0.03129905650959723,       0.0128439460063887864,
    0.00406026369752119785,    0.000799126982025303458, -0.0000217620709826578941, -0.0000789838734946418762,
    -0.0000225549897794351943, 1.90502227148173715e-6,  2.94251202417986134e-6,    4.05663556805982337e-7,
    -2.81510588778765747e-7,   -9.28687700112597812e-8, 2.32742215335848804e-8,    1.30436106583585705e-8,
    -1.36480797979707611e-9,   -1.07478622614420038e-9};

/// exp(x^2) erfc(x) for x >= 0, also infinite; absolute error below 1e-15: u is good to 5e-16 and the slope below 1.2.
template <int n>
Pack<double, n> scaled_erfc(Pack<double, n> const& x)
{
    using Real = Pack<double, n>;
    Real const u = 8 / (4 + x) - 1;
    // Even and odd powers apart, so that each addition waits for half as many others.
    Real const u2 = u * u;
    constexpr int count = static_cast<int>(std::size(scaled_erfc_coefficients));
    static_assert(count % 2 == 0);
    Real even = Real::Constant(scaled_erfc_coefficients[count - 2]),
         odd = Real::Constant(scaled_erfc_coefficients[count - 1]);
#pragma GCC unroll 16
    for (int j = count - 4; j >= 0; j -= 2)
    {
        even = plus_product(Real::Constant(scaled_erfc_coefficients[j]), even, u2);
        odd = plus_product(Real::Constant(scaled_erfc_coefficients[j + 1]), odd, u2);
    }
    return plus_product(even, odd, u);
}

}  // namespace gimdem::exec

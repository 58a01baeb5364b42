// SPDX-License-Identifier: BSD-3-Clause
/// A number of single precision that draws the constants of laws down to its own: 2.0 / 3.0 * x stays single. A law
/// written for a type Real serves it as it serves double and packs of numbers.
#pragma once

#include <cmath>
#include <type_traits>

#include "exec/Vector.hpp"

namespace gimdem::exec
{

struct Single
{
    float value;

    Single() = default;
    template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
    GIMDEM_HD constexpr Single(Number x) : value(static_cast<float>(x))  // constants of laws become single as they come
    {
    }
    GIMDEM_HD static Single Constant(double x) { return x; }
    GIMDEM_HD explicit operator double() const { return static_cast<double>(value); }

    GIMDEM_HD friend Single operator+(Single a, Single b) { return a.value + b.value; }
    GIMDEM_HD friend Single operator-(Single a, Single b) { return a.value - b.value; }
    GIMDEM_HD friend Single operator*(Single a, Single b) { return a.value * b.value; }
    GIMDEM_HD friend Single operator/(Single a, Single b) { return a.value / b.value; }
    GIMDEM_HD friend Single operator-(Single a) { return -a.value; }
};

template <>
inline constexpr bool is_single<Single> = true;

GIMDEM_HD inline bool greater(Single a, Single b)
{
    return a.value > b.value;
}
GIMDEM_HD inline Single choose(bool condition, Single yes, Single no)
{
    return condition ? yes : no;
}
GIMDEM_HD inline Single magnitude(Single x)
{
    return std::fabs(x.value);
}
GIMDEM_HD inline Single root(Single x)
{
    return std::sqrt(x.value);
}
/// The least number that has all its digits, for what must not divide by zero.
inline constexpr float least_single = 1.2e-38F;

/// 1 / sqrt x.
GIMDEM_HD inline Single per_root(Single x)
{
    return 1 / std::sqrt(x.value > least_single ? x.value : least_single);
}
/// sqrt(a / b) for a, b >= 0, and 1 where both are 0.
GIMDEM_HD inline Single root_of_ratio(Single a, Single b)
{
    return std::sqrt((a.value + least_single) / (b.value + least_single));
}

}  // namespace gimdem::exec

// SPDX-License-Identifier: BSD-3-Clause
/// The few operations that a law needs to be written once for a number and for many (an Eigen array).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

#include "exec/HostDevice.hpp"

namespace gimdem::exec
{

GIMDEM_HD inline double choose(bool condition, double yes, double no)
{
    return condition ? yes : no;
}
GIMDEM_HD inline double magnitude(double x)
{
    return std::fabs(x);
}
/// The same number in every lane.
template <class Real>
GIMDEM_HD Real broadcast(double x)
{
    if constexpr (std::is_floating_point_v<Real>)
        return x;
    else
        return Real::Constant(x);
}
GIMDEM_HD inline bool greater(double a, double b)
{
    return a > b;
}
GIMDEM_HD inline double root(double x)
{
    return std::sqrt(x);
}
/// 1 / sqrt x.
GIMDEM_HD inline double per_root(double x)
{
    return 1 / std::sqrt(x);
}
/// sqrt(a / b) for a, b >= 0, and 1 where both are 0.
GIMDEM_HD inline double root_of_ratio(double a, double b)
{
    constexpr double tiny = 1e-300;
    return std::sqrt((a + tiny) / (b + tiny));
}
GIMDEM_HD inline double exponential(double x)
{
    return std::exp(x);
}
GIMDEM_HD inline double logarithm(double x)
{
    return std::log(x);
}
template <class Real>
Real root(Eigen::ArrayBase<Real> const& x)
{
    return x.sqrt();
}
template <class Real>
Real exponential(Eigen::ArrayBase<Real> const& x)
{
    return x.exp();
}
template <class Real>
Real logarithm(Eigen::ArrayBase<Real> const& x)
{
    return x.log();
}

/// x, but no less than `floor`.
template <class Real, class Floor>
GIMDEM_HD Real no_less(Real const& x, Floor const& floor)
{
    Real const bound = [&]
    {
        if constexpr (std::is_same_v<Real, Floor>)
            return floor;
        else
            return broadcast<Real>(floor);
    }();
    return choose(greater(x, bound), x, bound);
}

}  // namespace gimdem::exec

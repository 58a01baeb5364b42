// SPDX-License-Identifier: BSD-3-Clause
/// The space that particles live in: open, or periodic along some axes, theory.md (D.70), (D.71).
#pragma once

#include <cmath>

#include "core/Case.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// Nearest whole number of |x| < 2^51, ties to even, for one number and for many: next to 1.5 * 2^52 there is no room
/// for a fraction.
template <class Real>
GIMDEM_HD Real nearest_whole(Real const& x)
{
    constexpr double large = 0x1.8p52;
    Real const whole = x + large;
    return whole - large;
}

/// No axis is periodic: a difference of positions is what it is, and costs nothing.
struct OpenSpace
{
    template <class Real>
    GIMDEM_HD void shorten(Real&, Real&, Real&) const
    {
    }
};

/// Some axes are periodic: a difference of positions becomes the one to the nearest image, (D.70). Along the other axes
/// both numbers are zero and leave it unchanged to the bit.
struct PeriodicSpace
{
    Constant3 period;      ///< L [m], 0: not periodic
    Constant3 per_period;  ///< 1/L [1/m], 0: not periodic

    template <class Real>
    GIMDEM_HD void shorten(Real& x, Real& y, Real& z) const
    {
        x -= period.x * nearest_whole(Real(x * per_period.x));
        y -= period.y * nearest_whole(Real(y * per_period.y));
        z -= period.z * nearest_whole(Real(z * per_period.z));
    }
};

/// Where the periodic axes begin, and their periods. Without any: unbounded space.
struct Domain
{
    Constant3 low{0, 0, 0};     ///< [m], means something along periodic axes only
    Constant3 period{0, 0, 0};  ///< L [m], 0: not periodic

    static Domain of(DomainSettings const& settings);

    bool is_periodic() const { return period.x > 0 || period.y > 0 || period.z > 0; }
    PeriodicSpace space() const;

    /// The image of x in the box, (D.71). What is inside keeps its bits.
    GIMDEM_HD Vec3 wrap(Vec3 const& x) const
    {
        return {wrap(x.x(), low.x, period.x), wrap(x.y(), low.y, period.y), wrap(x.z(), low.z, period.z)};
    }

    /// Throws UserError where a period is below twice the `reach` of the search [m]: two particles could meet through
    /// both sides at once.
    void require_room(double reach) const;

private:
    GIMDEM_HD static double wrap(double x, double low, double period)
    {
        if (!(period > 0) || (low <= x && x < low + period)) return x;
        double const wrapped = x - period * std::floor((x - low) / period);
        // Rounding must not put it beyond an end; a NaN stays one.
        return wrapped < low || wrapped >= low + period ? low : wrapped;
    }
};

/// Calls work(space) with the kind of space that the domain is, so that open scenes pay nothing for periodic ones.
template <class Work>
void in_space_of(Domain const& domain, Work&& work)
{
    if (domain.is_periodic())
        work(domain.space());
    else
        work(OpenSpace{});
}

}  // namespace gimdem

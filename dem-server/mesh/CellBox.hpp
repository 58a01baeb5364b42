// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "exec/Vector.hpp"

namespace gimdem
{

/// An axis-aligned box around a cell.
struct CellBox
{
    double low[3], high[3];  ///< [m]

    GIMDEM_HD bool holds(Vec3 const& x) const { return distance2(x) == 0; }
    /// Square of the distance of a point [m^2]; 0 inside.
    GIMDEM_HD double distance2(Vec3 const& x) const
    {
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis)
            sum += gap2(low[axis] - x[axis], x[axis] - high[axis]);
        return sum;
    }
    /// Square of the distance of another box [m^2]; 0 where they touch.
    GIMDEM_HD double distance2(CellBox const& other) const
    {
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis)
            sum += gap2(low[axis] - other.high[axis], other.low[axis] - high[axis]);
        return sum;
    }

private:
    GIMDEM_HD static double gap2(double below, double above)
    {
        double const gap = below > above ? below : above;
        return gap > 0 ? gap * gap : 0;
    }
};

}  // namespace gimdem

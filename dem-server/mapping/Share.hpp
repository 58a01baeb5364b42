// SPDX-License-Identifier: BSD-3-Clause
/// What cells receive of particles.
#pragma once

#include "exec/Buffer.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// A part of one or more particles: what one cell receives.
struct Share
{
    Quad drag;      ///< drag impulse [N s], w: of its coefficient [kg]
    double volume;  ///< [m^3]

    GIMDEM_HD void add(double weight, Share const& other)
    {
        drag.x += weight * other.drag.x;
        drag.y += weight * other.drag.y;
        drag.z += weight * other.drag.z;
        drag.w += weight * other.drag.w;
        volume += weight * other.volume;
    }
};

/// Cell sums of one mapping.
struct CellSums
{
    exec::Buffer<double> solid_volume;  ///< sum_p w_pi V_p [m^3]
    exec::Buffer<Quad> drag;            ///< sum_p w_pi J_p with J the drag impulse [N s], w: of its coefficient [kg]
};

}  // namespace gimdem

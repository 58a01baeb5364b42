// SPDX-License-Identifier: BSD-3-Clause
/// What every contact law gets and gives. Real is double for one contact, exec::Octet for eight at a time.
#pragma once

#include "exec/Vector.hpp"

namespace gimdem
{

/// Two bodies that overlap, seen at one instant. A wall has infinite mass and radius.
template <class Real>
struct ContactGeometry
{
    Vector3<Real> normal;    ///< unit vector towards body i, on which the force is asked
    Real overlap;           ///< delta > 0 [m]
    Vector3<Real> velocity;  ///< of i relative to j at the contact point [m/s]
    Real radius_eff;        ///< R*, (D.1) [m]
    Real mass_eff;          ///< m*, (D.2) [kg]
};

/// Force on body i; body j feels the opposite.
template <class Real>
struct ContactForce
{
    Vector3<Real> force;       ///< normal + tangential [N]
    Vector3<Real> tangential;  ///< [N]
};

}  // namespace gimdem

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
    Real overlap;            ///< delta > 0 [m]
    Vector3<Real> velocity;  ///< of i relative to j at the contact point [m/s]
    Real radius_eff;         ///< R*, (D.1) [m]
    Real mass_eff;           ///< m*, (D.2) [kg]

    // Only where the scene has rolling friction.
    Vector3<Real> spin{};    ///< angular velocity of i relative to j [rad/s]
    Real inverse_inertia{};  ///< 1/I_i + 1/I_j of the moments of inertia, wall: 1/I_i [1/(kg m^2)]

    // Only where the scene has cohesion.
    Real per_distance{};  ///< 1 / distance of the centres, 0 for a wall [1/m]
};

/// Force on body i; body j feels the opposite.
template <class Real>
struct ContactForce
{
    Vector3<Real> force;       ///< normal + tangential + cohesion [N]
    Vector3<Real> tangential;  ///< [N]
    Real normal;               ///< spring and dashpot, repulsive positive, without cohesion [N]
    Real stiffness;            ///< k_n: the elastic part of the normal force is k_n delta [N/m]
    Vector3<Real> rolling{};   ///< torque of rolling friction [N m]
};

/// What a contact remembers.
template <class Real>
struct ContactSprings
{
    Vector3<Real> tangential;  ///< elongation [m]
    Vector3<Real> rolling{};   ///< torque on i [N m]; only where a rolling law has a spring
};

}  // namespace gimdem

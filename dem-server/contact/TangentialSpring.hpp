// SPDX-License-Identifier: BSD-3-Clause
/// Friction between two surfaces: a spring and a dashpot in the contact plane under Coulomb's limit, theory.md
/// (D.9)-(D.12).
#pragma once

#include "exec/VectorMath.hpp"

namespace gimdem
{

/// Removes the part of a spring along the contact's normal, keeps its length, (D.9).
template <class Real>
GIMDEM_HD void turn_into_plane(Vector3<Real> const& normal, Vector3<Real>& spring)
{
    using namespace exec;
    Real const before = spring.dot(spring);
    spring = spring.minus(spring.dot(normal), normal);
    Real const after = spring.dot(spring);
    spring = root_of_ratio(before, after) * spring;
}

/// The friction of one instant. Every force law sets the three and takes the force from it.
template <class Real>
struct TangentialSpring
{
    Real stiffness;  ///< S_t or k_t [N/m]
    Real dashpot;    ///< eta_t [N s/m]
    Real limit;      ///< mu |F_n| [N]

    /// Force on body i [N] at the tangential velocity v_t [m/s]; `displacement` [m] is turned, stretched by dt [s], and
    /// shortened where the contact slides.
    GIMDEM_HD Vector3<Real> operator()(Vector3<Real> const& normal, Vector3<Real> const& v_t, double dt,
                                       Vector3<Real>& displacement) const
    {
        using namespace exec;
        turn_into_plane(normal, displacement);
        displacement = displacement.plus(broadcast<Real>(dt), v_t);

        // A sliding spring is as long as friction can hold, and has no dashpot.
        Real const spring2 = stiffness * stiffness * displacement.dot(displacement);
        auto const slides = greater(spring2, Real(limit * limit));
        // Computed for all lanes: a branch that some lane of eight takes is taken too often to be foreseen.
        Real const shortened = limit * per_root(spring2);
        displacement = choose(slides, shortened, broadcast<Real>(1)) * displacement;
        Real const damping = choose(slides, broadcast<Real>(0), dashpot);
        return (Real(-stiffness) * displacement).minus(damping, v_t);
    }
};

}  // namespace gimdem

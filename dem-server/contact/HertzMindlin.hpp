// SPDX-License-Identifier: BSD-3-Clause
/// Hertz-Mindlin contact with viscous damping and Coulomb friction, theory.md (D.5)-(D.12).
#pragma once

#include "contact/ContactGeometry.hpp"
#include "exec/VectorMath.hpp"
#include "particles/Materials.hpp"

namespace gimdem
{

/// The law. `displacement` is the tangential spring's elongation [m]: read, advanced by one step and truncated.
template <class Real, class Constants = ContactConstants>
struct HertzMindlin
{
    Constants constants;  ///< double: one pair of materials for all lanes
    double dt;            ///< DEM time step [s]

    GIMDEM_HD ContactForce<Real> operator()(ContactGeometry<Real> const& contact, Vector3<Real>& displacement) const
    {
        using namespace exec;
        // Stiffnesses S_n = 2 E* a, S_t = 8 G* a with the contact radius a, (D.5); dashpots 2 sqrt(5/6) |beta| sqrt(S
        // m*).
        Real const a = root(Real(contact.radius_eff * contact.overlap));
        Real const normal_stiffness = 2 * constants.young_eff * a;
        Real const tangential_stiffness = constants.stiffness_ratio * normal_stiffness;
        Real const normal_dashpot = constants.damping * root(Real(normal_stiffness * contact.mass_eff));
        Real const tangential_dashpot = constants.root_stiffness_ratio * normal_dashpot;

        // Normal: Hertz spring and dashpot, (D.6), (D.7).
        Real const v_n = contact.velocity.dot(contact.normal);
        Real const normal_force = 2.0 / 3.0 * normal_stiffness * contact.overlap - normal_dashpot * v_n;

        // Tangential: turn the spring with the contact plane, stretch it, (D.9), (D.10).
        Vector3<Real> const v_t = contact.velocity - v_n * contact.normal;
        turn_into_plane(contact.normal, displacement);
        displacement = displacement + broadcast<Real>(dt) * v_t;

        // Coulomb: a sliding spring is as long as friction can hold, and has no dashpot, (D.11), (D.12).
        Real const limit = constants.friction * magnitude(normal_force);
        Real const spring2 = tangential_stiffness * tangential_stiffness * displacement.dot(displacement);
        auto const slides = greater(spring2, Real(limit * limit));
        // Computed for all lanes: a branch that some lane of eight takes is taken too often to be foreseen.
        Real const shortened = limit / root(Real(spring2 + tiny));
        displacement = choose(slides, shortened, broadcast<Real>(1)) * displacement;
        Real const dashpot = choose(slides, broadcast<Real>(0), tangential_dashpot);
        Vector3<Real> const tangential = Real(-tangential_stiffness) * displacement - dashpot * v_t;
        return {normal_force * contact.normal + tangential, tangential};
    }

private:
    static constexpr double tiny = 1e-300;

    /// Remove the normal part, keep the length.
    GIMDEM_HD static void turn_into_plane(Vector3<Real> const& normal, Vector3<Real>& displacement)
    {
        using namespace exec;
        Real const before = displacement.dot(displacement);
        displacement = displacement - displacement.dot(normal) * normal;
        // The smallest numbers keep 0 / 0 away: an unstretched spring stays one.
        Real const after = displacement.dot(displacement);
        displacement = root(Real((before + tiny) / (after + tiny))) * displacement;
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Hertz-Mindlin contact with viscous damping and Coulomb friction, theory.md (D.5)-(D.12).
#pragma once

#include <string_view>

#include "contact/ContactGeometry.hpp"
#include "contact/TangentialSpring.hpp"
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
        Real const tangential_dashpot = constants.tangential_share * normal_dashpot;

        // Normal: Hertz spring and dashpot, (D.6), (D.7).
        Real const v_n = contact.velocity.dot(contact.normal);
        Real const secant = 2.0 / 3.0 * normal_stiffness;
        Real const normal_force =
            no_less(minus_product(Real(secant * contact.overlap), normal_dashpot, v_n), constants.least_force);

        // Tangential, (D.9)-(D.12).
        Vector3<Real> const v_t = contact.velocity.minus(v_n, contact.normal);
        TangentialSpring<Real> const rub{tangential_stiffness, tangential_dashpot,
                                         constants.friction * magnitude(normal_force)};
        Vector3<Real> const tangential = rub(contact.normal, v_t, dt, displacement);
        return {tangential.plus(normal_force, contact.normal), tangential, normal_force, secant};
    }
};

/// The same for the table of laws.
struct HertzMindlinLaw
{
    static constexpr std::string_view name = "hertz-mindlin";
    template <class Real>
    using Constants = ContactConstantsOf<Real>;

    static ContactConstants constants(MaterialSettings const& a, MaterialSettings const& b, ContactSettings const& pair)
    {
        return contact_constants(a, b, pair);
    }
    template <class Real, class Given>
    GIMDEM_HD static ContactForce<Real> apply(Given const& constants, double dt, ContactGeometry<Real> const& contact,
                                              Vector3<Real>& displacement)
    {
        return HertzMindlin<Real, Given>{constants, dt}(contact, displacement);
    }
};

}  // namespace gimdem

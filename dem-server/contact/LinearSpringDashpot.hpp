// SPDX-License-Identifier: BSD-3-Clause
/// Linear spring and dashpot with Coulomb friction, theory.md (D.30)-(D.33).
#pragma once

#include <cmath>
#include <numbers>
#include <string_view>
#include <type_traits>

#include "contact/ContactGeometry.hpp"
#include "contact/Restitution.hpp"
#include "contact/TangentialSpring.hpp"
#include "core/Case.hpp"
#include "particles/Materials.hpp"

namespace gimdem
{

template <class Real>
struct LinearConstants
{
    Real stiffness;         ///< k_n [N/m]
    Real damping;           ///< 2 |beta|, (D.8), (D.30) [1]
    Real stiffness_ratio;   ///< k_t / k_n [1]
    Real friction;          ///< Coulomb coefficient [1]
    Real tangential_share;  ///< eta_t / eta_n: 1/2, 0 without a tangential dashpot [1]
    Real least_force;       ///< below which the normal force does not fall [N]: 0, or far below any
};

struct LinearSpringDashpot
{
    static constexpr std::string_view name = "linear";
    template <class Real>
    using Constants = LinearConstants<Real>;

    static LinearConstants<double> constants(MaterialSettings const&, MaterialSettings const&,
                                             ContactSettings const& pair)
    {
        double const beta = pair.limit_damping ? damping_ratio_without_attraction(pair.restitution, Stiffening::linear)
                                               : damping_ratio(pair.restitution);
        return {.stiffness = pair.normal_stiffness,
                .damping = 2 * beta,
                .stiffness_ratio = pair.tangential_stiffness_ratio,
                .friction = pair.friction,
                .tangential_share = pair.tangential_damping ? 0.5 : 0,
                .least_force = least_normal_force(pair)};
    }

    template <class Real, class Given>
    GIMDEM_HD static ContactForce<Real> apply(Given const& constants, double dt, ContactGeometry<Real> const& contact,
                                              Vector3<Real>& displacement)
    {
        using namespace exec;
        // Normal, (D.30).
        Real const stiffness = in_every_lane<Real>(constants.stiffness);
        Real const dashpot = constants.damping * root(Real(stiffness * contact.mass_eff));
        Real const v_n = contact.velocity.dot(contact.normal);
        Real const normal_force =
            no_less(minus_product(Real(stiffness * contact.overlap), dashpot, v_n), constants.least_force);

        // Tangential, (D.32), (D.9)-(D.12).
        Vector3<Real> const v_t = contact.velocity.minus(v_n, contact.normal);
        TangentialSpring<Real> const rub{constants.stiffness_ratio * stiffness, constants.tangential_share * dashpot,
                                         constants.friction * magnitude(normal_force)};
        Vector3<Real> const tangential = rub(contact.normal, v_t, dt, displacement);
        return {tangential.plus(normal_force, contact.normal), tangential, normal_force, stiffness};
    }

    /// How long a contact without damping lasts [s], (D.31). stiffness [N/m], mass_eff [kg].
    static double duration(double stiffness, double mass_eff)
    {
        return std::numbers::pi * std::sqrt(mass_eff / stiffness);
    }

private:
    /// A constant in every lane.
    template <class Real, class Value>
    GIMDEM_HD static Real in_every_lane(Value const& value)
    {
        if constexpr (std::is_same_v<Real, Value>)
            return value;
        else
            return exec::broadcast<Real>(value);
    }
};

}  // namespace gimdem

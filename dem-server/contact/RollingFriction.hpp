// SPDX-License-Identifier: BSD-3-Clause
/// Resistance to rolling, theory.md (D.34)-(D.39).
#pragma once

#include <string_view>

#include "contact/ContactGeometry.hpp"
#include "contact/TangentialSpring.hpp"
#include "core/Case.hpp"

namespace gimdem
{

/// Spheres roll freely.
struct NoRolling
{
    static constexpr std::string_view name = "none";
    static constexpr bool has_spring = false;
    template <class Real>
    struct Constants
    {
    };
    static Constants<double> constants(MaterialSettings const&, MaterialSettings const&, ContactSettings const&)
    {
        return {};
    }
};

/// Constant directional torque, (D.34).
struct ConstantTorque
{
    static constexpr std::string_view name = "cdt";
    static constexpr bool has_spring = false;
    template <class Real>
    struct Constants
    {
        Real rolling_friction;  ///< mu_r [1]
    };
    static Constants<double> constants(MaterialSettings const&, MaterialSettings const&, ContactSettings const& pair)
    {
        return {pair.rolling_friction};
    }

    /// Torque on i [N m].
    template <class Real, class Given>
    GIMDEM_HD static Vector3<Real> apply(Given const& constants, double, ContactGeometry<Real> const& contact,
                                         ContactForce<Real> const& force, Vector3<Real>&)
    {
        using namespace exec;
        Real const elastic = force.stiffness * contact.overlap;
        Real const rate2 = contact.spin.dot(contact.spin);
        Real const zero = broadcast<Real>(0);
        Real const per_rate = choose(greater(rate2, zero), Real(1 / root(rate2)), zero);
        Vector3<Real> const rolling = contact.spin - contact.spin.dot(contact.normal) * contact.normal;
        return Real(-constants.rolling_friction * contact.radius_eff * elastic * per_rate) * rolling;
    }
};

/// Elastic-plastic spring-dashpot, (D.35)-(D.39): comes to rest exactly.
struct ElasticPlasticSpring
{
    static constexpr std::string_view name = "epsd";
    static constexpr bool has_spring = true;
    template <class Real>
    struct Constants
    {
        Real rolling_friction;  ///< mu_r [1]
        Real rolling_damping;   ///< eta_r [1]
    };
    static Constants<double> constants(MaterialSettings const&, MaterialSettings const&, ContactSettings const& pair)
    {
        return {pair.rolling_friction, pair.rolling_damping};
    }

    /// Torque on i [N m]; `spring` is its elastic part.
    template <class Real, class Given>
    GIMDEM_HD static Vector3<Real> apply(Given const& constants, double dt, ContactGeometry<Real> const& contact,
                                         ContactForce<Real> const& force, Vector3<Real>& spring)
    {
        using namespace exec;
        Real const arm = constants.rolling_friction * contact.radius_eff;
        Real const stiffness = 2.25 * force.stiffness * arm * arm;
        Vector3<Real> const rolling = contact.spin - contact.spin.dot(contact.normal) * contact.normal;
        turn_into_plane(contact.normal, spring);
        spring = spring - Real(stiffness * dt) * rolling;

        // At full mobilisation the spring slips and the dashpot is off.
        Real const limit = arm * magnitude(force.normal);
        Real const spring2 = spring.dot(spring);
        auto const slips = greater(spring2, Real(limit * limit));
        Real const one = broadcast<Real>(1);
        spring = choose(slips, Real(limit * per_root(spring2)), one) * spring;
        Real const inertia = 3.5 / contact.inverse_inertia;
        Real const dashpot = 2 * constants.rolling_damping * root(Real(inertia * stiffness));
        return spring - choose(slips, broadcast<Real>(0), dashpot) * rolling;
    }
};

}  // namespace gimdem

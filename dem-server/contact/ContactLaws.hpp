// SPDX-License-Identifier: BSD-3-Clause
/// Every law that a scene can choose from. docs/add-a-contact-law.md tells how to add one.
#pragma once

#include <type_traits>

#include "contact/Cohesion.hpp"
#include "contact/HertzMindlin.hpp"
#include "contact/LinearSpringDashpot.hpp"
#include "contact/RollingFriction.hpp"
#include "core/ContactLawNames.hpp"

namespace gimdem
{

template <class... Law>
struct LawList
{
    static constexpr std::size_t count = sizeof...(Law);

    /// Whether the laws are called as the case file calls them.
    template <std::size_t n>
    static constexpr bool are_called(std::string_view const (&names)[n])
    {
        std::size_t i = 0;
        return n == count && ((names[i++] == Law::name) && ...);
    }

    /// Calls work.template operator()<Law>() with the law of this name; false where there is none.
    template <class Work>
    static bool select(std::string_view name, Work const& work)
    {
        return ((name == Law::name && (work.template operator()<Law>(), true)) || ...);
    }
};

using ForceLaws = LawList<HertzMindlinLaw, LinearSpringDashpot>;
using RollingLaws = LawList<NoRolling, ConstantTorque, ElasticPlasticSpring>;
using CohesionLaws = LawList<NoCohesion, Sjkr>;

static_assert(ForceLaws::are_called(force_law_names), "core/ContactLawNames.hpp must list the same laws");
static_assert(RollingLaws::are_called(rolling_law_names), "core/ContactLawNames.hpp must list the same laws");
static_assert(CohesionLaws::are_called(cohesion_law_names), "core/ContactLawNames.hpp must list the same laws");

/// Constants of a pair of materials for one choice of laws; Real is double, or exec::Octet for eight pairs.
template <class Real_, class Force, class Rolling, class Cohesion>
struct LawConstants : Force::template Constants<Real_>,
                      Rolling::template Constants<Real_>,
                      Cohesion::template Constants<Real_>
{
    using Real = Real_;
};

/// One choice of laws, as kernels are specialised on it: what a scene does not have costs it nothing.
template <class Force_, class Rolling_ = NoRolling, class Cohesion_ = NoCohesion>
struct ContactLaw
{
    using Force = Force_;
    using Rolling = Rolling_;
    using Cohesion = Cohesion_;
    template <class Real>
    using Constants = LawConstants<Real, Force, Rolling, Cohesion>;

    static constexpr bool rolls = !std::is_same_v<Rolling, NoRolling>;
    static constexpr bool has_rolling_spring = Rolling::has_spring;
    /// The laws of most scenes: worth kernels of their own for particles of one size.
    static constexpr bool is_plain = std::is_same_v<Force, HertzMindlinLaw> && std::is_same_v<Rolling, NoRolling> &&
                                     std::is_same_v<Cohesion, NoCohesion>;
    static constexpr bool coheres = !std::is_same_v<Cohesion, NoCohesion>;

    static Constants<double> constants(MaterialSettings const& a, MaterialSettings const& b,
                                       ContactSettings const& pair)
    {
        return {Force::constants(a, b, pair), Rolling::constants(a, b, pair), Cohesion::constants(a, b, pair)};
    }

    /// Force and torque on body i; the springs go one step dt [s] on.
    template <class Real, class Given>
    GIMDEM_HD static ContactForce<Real> apply(Given const& constants, double dt, ContactGeometry<Real> const& contact,
                                              ContactSprings<Real>& springs)
    {
        using Scalar = typename Given::Real;
        typename Force::template Constants<Scalar> const& of_force = constants;
        ContactForce<Real> out = Force::template apply<Real>(of_force, dt, contact, springs.tangential);
        if constexpr (rolls)
        {
            typename Rolling::template Constants<Scalar> const& of_rolling = constants;
            out.rolling = Rolling::template apply<Real>(of_rolling, dt, contact, out, springs.rolling);
        }
        if constexpr (coheres)
        {
            typename Cohesion::template Constants<Scalar> const& of_cohesion = constants;
            out.force = out.force - Cohesion::template apply<Real>(of_cohesion, contact) * contact.normal;
        }
        return out;
    }
};

}  // namespace gimdem

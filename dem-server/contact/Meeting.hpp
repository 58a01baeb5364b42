// SPDX-License-Identifier: BSD-3-Clause
/// How two spheres meet: what contact laws need to know, from where the two are and how they move. Real is double for
/// one pair, exec::Octet for eight.
#pragma once

#include <type_traits>

#include "contact/ContactGeometry.hpp"
#include "exec/VectorMath.hpp"

namespace gimdem
{

/// A sphere and its motion.
template <class Real>
struct MovingSphere
{
    Vector3<Real> position, velocity, spin;      ///< [m], [m/s], [rad/s]
    Real radius, inverse_mass, inverse_inertia;  ///< [m], [1/kg], [1/(kg m^2)]
};

/// Two spheres that touch.
template <class Real>
struct Encounter
{
    Vector3<Real> between;         ///< centre of a - centre of b [m]
    Real square;                   ///< its square [m^2]
    Real closeness;                ///< (r_a + r_b)^2 - square [m^2]; only where Real is of single precision
    Vector3<Real> velocity;        ///< of a relative to b [m/s]
    Vector3<Real> spin_a, spin_b;  ///< [rad/s]; spheres of one size that do not resist rolling: their sum, and nothing
    Real radius_a, radius_b;       ///< [m]
    Real inverse_mass;             ///< 1/m_a + 1/m_b [1/kg]
    Real inverse_inertia;          ///< 1/I_a + 1/I_b [1/(kg m^2)]
};

template <class Real, class Space>
GIMDEM_HD Encounter<Real> encounter(MovingSphere<Real> const& a, MovingSphere<Real> const& b, Space const& space)
{
    Vector3<Real> between = a.position - b.position;
    space.shorten(between.x, between.y, between.z);
    return {.between = between,
            .square = between.dot(between),
            .closeness = {},
            .velocity = a.velocity - b.velocity,
            .spin_a = a.spin,
            .spin_b = b.spin,
            .radius_a = a.radius,
            .radius_b = b.radius,
            .inverse_mass = a.inverse_mass + b.inverse_mass,
            .inverse_inertia = a.inverse_inertia + b.inverse_inertia};
}

/// The same in the precision of Real: differences of positions and of squares are taken in double.
template <class Real, class Space>
GIMDEM_HD Encounter<Real> encounter_in(MovingSphere<double> const& a, MovingSphere<double> const& b, Space const& space)
{
    Encounter<double> const met = encounter(a, b, space);
    if constexpr (!exec::is_single<Real>)
        return met;
    else
    {
        double const reach = a.radius + b.radius;
        auto const narrow = [](Vector3<double> const& v) { return Vector3<Real>{v.x, v.y, v.z}; };
        return {.between = narrow(met.between),
                .square = met.square,
                .closeness = reach * reach - met.square,
                .velocity = narrow(met.velocity),
                .spin_a = narrow(met.spin_a),
                .spin_b = narrow(met.spin_b),
                .radius_a = met.radius_a,
                .radius_b = met.radius_b,
                .inverse_mass = met.inverse_mass,
                .inverse_inertia = met.inverse_inertia};
    }
}

/// r_a + r_b - distance [m]. In single precision the difference of two lengths would have lost the digits of a small
/// overlap; it comes from the difference of their squares, taken in double, (D.91).
template <class Real>
GIMDEM_HD Real overlap_of(Encounter<Real> const& met, Real const& reach, Real const& per_distance)
{
    using namespace exec;
    if constexpr (is_single<Real>)
        return met.closeness / plus_product(reach, met.square, per_distance);
    else
        return minus_product(reach, met.square, per_distance);
}

/// Geometry of a contact, theory.md (D.1), (D.2). `one_size`: all spheres have one radius.
template <class Law, bool one_size, class Real>
GIMDEM_HD ContactGeometry<Real> meet(Encounter<Real> const& met)
{
    using namespace exec;
    // Two centres in one place have no normal; any direction parts them.
    auto const apart = greater(met.square, broadcast<Real>(0));
    Real const one = broadcast<Real>(1);
    Real const per_distance = per_root(choose(apart, met.square, one));
    Vector3<Real> normal = per_distance * met.between;
    normal.z = choose(apart, normal.z, one);
    Real const reach = met.radius_a + met.radius_b;
    Real const overlap = overlap_of(met, reach, per_distance);
    Real const half = overlap / 2;
    Vector3<Real> spin;
    if constexpr (one_size && !Law::rolls)
        spin = Real(met.radius_a - half) * met.spin_a;
    else
        spin = (Real(met.radius_a - half) * met.spin_a).plus(Real(met.radius_b - half), met.spin_b);
    ContactGeometry<Real> contact{
        .normal = normal,
        .overlap = overlap,
        .velocity = met.velocity - spin.cross(normal),
        .radius_eff = one_size ? Real(met.radius_a / 2) : Real(met.radius_a * met.radius_b / reach),
        .mass_eff = 1 / met.inverse_mass};
    if constexpr (Law::rolls)
    {
        contact.spin = met.spin_a - met.spin_b;
        contact.inverse_inertia = met.inverse_inertia;
    }
    if constexpr (Law::coheres) contact.per_distance = per_distance;
    return contact;
}

}  // namespace gimdem

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

/// A number that is the same in every lane.
GIMDEM_HD inline double any_lane(double x)
{
    return x;
}
template <class Real>
double any_lane(Eigen::ArrayBase<Real> const& x)
{
    return x[0];
}

/// Geometry of the contact of a with b, theory.md (D.1), (D.2). `one_size`: all spheres have one radius and one mass.
template <class Law, bool one_size, class Real, class Space>
GIMDEM_HD ContactGeometry<Real> meet(MovingSphere<Real> const& a, MovingSphere<Real> const& b, Space const& space)
{
    using namespace exec;
    Vector3<Real> between = a.position - b.position;
    space.shorten(between.x, between.y, between.z);
    Real const reach = a.radius + b.radius;
    Real const distance = root(Real(between.dot(between)));
    // Two centres in one place have no normal; any direction parts them.
    auto const apart = greater(distance, broadcast<Real>(0));
    Real const one = broadcast<Real>(1);
    Real const per_distance = one / choose(apart, distance, one);
    Vector3<Real> normal = per_distance * between;
    normal.z = choose(apart, normal.z, one);
    Real const overlap = reach - distance;
    Vector3<Real> const spin = Real(a.radius - overlap / 2) * a.spin + Real(b.radius - overlap / 2) * b.spin;
    ContactGeometry<Real> contact{.normal = normal,
                                  .overlap = overlap,
                                  .velocity = a.velocity - b.velocity - spin.cross(normal),
                                  .radius_eff = {},
                                  .mass_eff = {}};
    if constexpr (one_size)
    {
        contact.radius_eff = broadcast<Real>(any_lane(a.radius) / 2);
        contact.mass_eff = broadcast<Real>(0.5 / any_lane(a.inverse_mass));
    }
    else
    {
        contact.radius_eff = a.radius * b.radius / reach;
        contact.mass_eff = 1 / (a.inverse_mass + b.inverse_mass);
    }
    if constexpr (Law::rolls)
    {
        contact.spin = a.spin - b.spin;
        contact.inverse_inertia = a.inverse_inertia + b.inverse_inertia;
    }
    if constexpr (Law::coheres) contact.per_distance = per_distance;
    return contact;
}

}  // namespace gimdem

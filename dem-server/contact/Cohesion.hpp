// SPDX-License-Identifier: BSD-3-Clause
/// Attraction of surfaces in contact, theory.md (D.40), (D.41).
#pragma once

#include <numbers>
#include <string_view>

#include "contact/ContactGeometry.hpp"
#include "core/Case.hpp"

namespace gimdem
{

/// Dry, clean, coarse.
struct NoCohesion
{
    static constexpr std::string_view name = "none";
    template <class Real>
    struct Constants
    {
    };
    static Constants<double> constants(MaterialSettings const&, MaterialSettings const&, ContactSettings const&)
    {
        return {};
    }
};

/// Simplified JKR: a force in proportion to the area in which the two spheres cut each other.
struct Sjkr
{
    static constexpr std::string_view name = "sjkr";
    template <class Real>
    struct Constants
    {
        Real energy_density;  ///< k_c [J/m^3]
    };
    static Constants<double> constants(MaterialSettings const&, MaterialSettings const&, ContactSettings const& pair)
    {
        return {pair.cohesion_energy_density};
    }

    /// Attraction [N], (D.41).
    template <class Real, class Given>
    GIMDEM_HD static Real apply(Given const& constants, ContactGeometry<Real> const& contact)
    {
        return constants.energy_density * area(contact);
    }

    /// Area of the circle in which two spheres, or a sphere and a plane, cut each other [m^2], (D.40).
    template <class Real>
    GIMDEM_HD static Real area(ContactGeometry<Real> const& contact)
    {
        Real const d = contact.overlap;
        Real const c = contact.per_distance;
        Real const s = 1 + d * c;
        return (std::numbers::pi / 4) * d * (2 * s - d * c) * (4 * contact.radius_eff * s - 2 * s * d + d * d * c);
    }
};

}  // namespace gimdem

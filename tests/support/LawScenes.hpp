// SPDX-License-Identifier: BSD-3-Clause
/// Every choice of contact laws, and contacts to try them on.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "TestCase.hpp"
#include "contact/ContactGeometry.hpp"
#include "core/ContactLawNames.hpp"

namespace gimdem::test
{

/// Every choice of laws, with a value for all that one of them may need.
inline std::vector<Case> all_laws()
{
    std::vector<Case> cases;
    for (auto const force : force_law_names)
        for (auto const rolling : rolling_law_names)
            for (auto const cohesion : cohesion_law_names)
            {
                Case settings = bead_case(0.6, 0.3);
                settings.dem.gravity = {0, 0, -9.81};
                settings.dem.contact_law = force;
                settings.dem.rolling_friction = rolling;
                settings.dem.cohesion = cohesion;
                settings.contacts[0].normal_stiffness = 50;
                settings.contacts[0].rolling_friction = 0.2;
                settings.contacts[0].rolling_damping = 0.3;
                settings.contacts[0].cohesion_energy_density = 1000;
                cases.push_back(settings);
            }
    return cases;
}

inline std::string name_of_laws(Case const& settings)
{
    return settings.dem.contact_law + ' ' + settings.dem.rolling_friction + ' ' + settings.dem.cohesion;
}

/// A number in [-1, 1] that looks random.
inline double noise(int n)
{
    return std::sin(12.9898 * n + 78.233 * std::cos(4.1 * n));
}
inline Vector3<double> noisy(int n, double size)
{
    return {size * noise(n), size * noise(n + 1), size * noise(n + 2)};
}

/// A contact of beads in a bed: overlaps of 0.1 to 2 %, 0.1 m/s.
inline ContactGeometry<double> contact_of(int n)
{
    Vector3<double> const normal = noisy(n, 1);
    return {.normal = (1 / std::sqrt(normal.dot(normal))) * normal,
            .overlap = 1e-5 * (1.1 + noise(n + 10)),
            .velocity = noisy(n + 20, 0.1),
            .radius_eff = 1e-3 * (1.5 + noise(n + 30)),
            .mass_eff = 1e-6 * (1.5 + noise(n + 31)),
            .spin = noisy(n + 40, 30),
            .inverse_inertia = 1e12 * (1.5 + noise(n + 50)),
            .per_distance = 400};
}

}  // namespace gimdem::test

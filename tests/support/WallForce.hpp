// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestCase.hpp"
#include "walls/WallContacts.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem::test
{

/// Force of the walls on one bead at rest [N]; w: contacts.
inline Quad wall_force(WallGeometry const& walls, Vec3 const& x, double radius)
{
    Case const settings = bead_case();
    Materials const materials(settings);
    auto particles = particles_of({{x, radius}});
    WallContacts contacts(serial, materials, 0, walls);
    contacts.build(particles, 0.1 * radius, {});
    contacts.add_forces(particles, 0);
    return contacts.force_on(0);
}

}  // namespace gimdem::test

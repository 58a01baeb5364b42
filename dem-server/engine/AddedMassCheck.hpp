// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

namespace gimdem
{

/// What to tell the user where the fluid that particles displace answers their acceleration with more mass than they
/// have, so that solving one after the other may diverge whatever the time step, theory.md (C.19). Densities in
/// [kg/m^3]; void_fraction: of each cell. Empty where there is nothing to tell.
std::string note_on_added_mass(double fluid_density, double lightest_particle_density,
                               std::span<double const> void_fraction);

}  // namespace gimdem

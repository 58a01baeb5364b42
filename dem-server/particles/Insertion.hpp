// SPDX-License-Identifier: BSD-3-Clause
/// Where the particles start: lattices, files and random places.
#pragma once

#include "core/Case.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// All particles that [[insertion]] asks for, ids 0, 1, 2 ... in order of insertion.
///
/// Throws UserError when a lattice does not fit its box, a file cannot be read or holds a line that is not numbers, or
/// two particles overlap by more than 1 % of the smaller diameter (names both and the overlap).
ParticleState insert_particles(Case const& settings, Materials const& materials);

/// Number of spheres of `diameter` and `density` that weigh `mass`, to the nearest.
std::int64_t count_of_mass(double mass, double diameter, double density);

}  // namespace gimdem

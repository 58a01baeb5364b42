// SPDX-License-Identifier: BSD-3-Clause
/// Particles must start where the walls let them be.
#pragma once

#include "particles/ParticleState.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem
{

/// Largest share of its diameter that a particle may be in a wall at the start: insertion may jitter that much.
inline constexpr double start_overlap_limit = 0.05;

/// Throws UserError where a particle is in a wall at the start, or on the wrong side of a plane, an endless tube or a
/// closed surface of the case file: names the particle and the wall.
void check_particles_against_walls(ParticleState const& particles, WallGeometry const& walls);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// A moving wall must not jump over a particle from one step to the next.
#pragma once

#include "core/Case.hpp"
#include "mesh/PolyMesh.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem
{

/// Largest way of a wall in one step, along its normal, in smallest radii: what touches nothing before the step is then
/// still on its side of the wall afterwards, with room for its own motion, (D.58).
inline constexpr double wall_step_limit = 0.5;

/// Throws UserError where a wall moves farther than that: names the wall and the largest time step. `mesh`: where
/// particles can be.
void check_wall_steps(Case const& settings, WallGeometry const& walls, PolyMesh const& mesh, double smallest_radius);

}  // namespace gimdem

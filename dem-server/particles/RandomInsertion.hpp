// SPDX-License-Identifier: BSD-3-Clause
/// Spheres at random places of a box that overlap nothing.
#pragma once

#include <vector>

#include "core/Case.hpp"
#include "particles/SphereSeed.hpp"

namespace gimdem
{

/// Tries of one sphere before the box is called full.
inline constexpr int most_attempts = 20000;

/// Spheres of an [[insertion]] with arrangement "random", the largest first: each is put where it lies wholly in the
/// box and overlaps neither another nor a particle that is there already; a place that is taken is drawn again. Throws
/// UserError, with the solid fraction reached (D.65), once a sphere found no place in most_attempts tries.
std::vector<SphereSeed> random_spheres_in_box(InsertionSettings const& settings, double density,
                                              ParticleState const& present);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Whether a scene can be computed in the precision that was asked for.
#pragma once

#include "core/Case.hpp"

namespace gimdem
{

/// Smallest radius for contact laws in single precision [m]. Below, squares of what a contact remembers fall out of its
/// range: of a bead of this radius they are 1e-33 at least, and the range ends at 1e-38.
inline constexpr double smallest_radius_in_single = 1e-5;

/// Throws UserError for precision "mixed" with smaller particles.
void check_precision(Case const& settings, double smallest_radius);

}  // namespace gimdem

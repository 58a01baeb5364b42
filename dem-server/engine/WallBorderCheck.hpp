// SPDX-License-Identifier: BSD-3-Clause
/// Walls and periodic borders: a wall is where it is, and has no image on the other side.
#pragma once

#include "core/Case.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem
{

/// Throws UserError where a particle could feel a wall through a periodic border, or where a wall ends there, at any
/// time of its motion, (D.59): names the wall and the border. Planes and endless tubes along a periodic axis have no
/// end. `reach` [m]: how near a particle's centre can be to a wall that it feels.
void check_walls_in_periodic_box(DomainSettings const& domain, WallGeometry const& walls, double reach);

}  // namespace gimdem

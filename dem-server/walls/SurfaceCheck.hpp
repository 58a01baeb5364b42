// SPDX-License-Identifier: BSD-3-Clause
/// What a triangulated surface must be to stop particles.
#pragma once

#include <string>

#include "walls/SurfaceMesh.hpp"

namespace gimdem
{

/// Throws UserError, with `source` (a file) and the number of a triangle, counted from 1, where there is no triangle, a
/// corner is not finite, or a triangle has no area; unless `open`, also where the surface is not closed, triangles side
/// by side are wound against each other, or the whole surface is inside out.
void check_surface(SurfaceMesh const& surface, std::string const& source, bool open);

/// Volume enclosed by a closed surface [m^3]; negative where it is inside out, theory.md (D.52).
double signed_volume(SurfaceMesh const& surface);

}  // namespace gimdem

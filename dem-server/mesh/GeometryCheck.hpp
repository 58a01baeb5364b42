// SPDX-License-Identifier: BSD-3-Clause
/// Meshes that particles cannot be mapped onto, theory.md (G.2a).
#pragma once

#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// The points of a face may be off its plane by this part of the cube root of the smaller of its cells' volumes.
/// Duals of good tetrahedral meshes have up to 0.31.
constexpr double largest_face_warp = 0.5;
/// The sum of a cell's face areas, which is zero where it is closed, may be this part of their magnitudes.
constexpr double largest_opening = 1e-6;
/// A cell's volume is at least this part of its surface to the power of 3/2 (a cube's is 0.068).
constexpr double smallest_cell_volume = 1e-10;

/// Throws UserError for an open cell, one turned inside out or without volume, a face that comes twice, and a face that
/// is too far from planar. Names the cell or face, its place, and what to do.
void check_geometry(PolyMesh const& mesh);

}  // namespace gimdem

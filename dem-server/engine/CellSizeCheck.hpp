// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// What to tell the user where particles of this radius [m] have more volume than a cell: it works, but the fluid knows
/// nothing of the flow around them. Empty where all cells are larger.
std::string note_on_small_cells(PolyMesh const& mesh, double largest_radius);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Which cells are within a distance of which, by the boxes around them.
#pragma once

#include "mesh/BoxGrid.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

exec::Buffer<CellBox> cell_boxes(PolyMesh const& mesh);

/// For each cell itself, then in rising order all whose boxes are at most `reach` [m] from its own.
CellRows nearby_cells(exec::Buffer<CellBox> const& boxes, double reach);

}  // namespace gimdem

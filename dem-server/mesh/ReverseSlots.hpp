// SPDX-License-Identifier: BSD-3-Clause
/// Where a cell stands in the rows of the cells of its own row.
#pragma once

#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// For each entry, cell j in the row of cell i, the place of i in the row of j. shape=(rows.cells.size(),)
exec::Buffer<std::int32_t> reverse_slots(CellRows const& rows);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "search/CellGrid.hpp"

#include <algorithm>
#include <cmath>

namespace gimdem
{

CellGrid CellGrid::over(Vec3 const& low, Vec3 const& high, double cell_size, std::int64_t most_cells)
{
    CellGrid grid;
    grid.origin = {low.x(), low.y(), low.z()};
    Vec3 const size = high - low;
    auto const cells_along = [&](double length) { return std::max(1.0, std::floor(length / cell_size) + 1); };
    while (cells_along(size.x()) * cells_along(size.y()) * cells_along(size.z()) > static_cast<double>(most_cells))
        cell_size *= 1.25;
    grid.cell_size = cell_size;
    grid.nx = static_cast<std::int32_t>(cells_along(size.x()));
    grid.ny = static_cast<std::int32_t>(cells_along(size.y()));
    grid.nz = static_cast<std::int32_t>(cells_along(size.z()));
    return grid;
}

}  // namespace gimdem

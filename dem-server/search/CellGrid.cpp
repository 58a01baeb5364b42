// SPDX-License-Identifier: BSD-3-Clause
#include "search/CellGrid.hpp"

#include <algorithm>
#include <cmath>

namespace gimdem
{

CellGrid CellGrid::over(Vec3 const& low, Vec3 const& high, double cell_size, std::int64_t most_cells,
                        Constant3 const& whole_cells)
{
    CellGrid grid;
    grid.origin = {low.x(), low.y(), low.z()};
    Vec3 const size = high - low;
    auto const cells_along = [&](double length, double whole)
    { return std::max(1.0, std::floor(length / cell_size) + (whole != 0 ? 0 : 1)); };
    auto const x = [&] { return cells_along(size.x(), whole_cells.x); };
    auto const y = [&] { return cells_along(size.y(), whole_cells.y); };
    auto const z = [&] { return cells_along(size.z(), whole_cells.z); };
    while (x() * y() * z() > static_cast<double>(most_cells))
        cell_size *= 1.25;
    grid.cell_size = cell_size;
    grid.nx = static_cast<std::int32_t>(x());
    grid.ny = static_cast<std::int32_t>(y());
    grid.nz = static_cast<std::int32_t>(z());
    return grid;
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// A uniform grid of cubes over a box. Cells are numbered x first, so neighbours along x are consecutive.
#pragma once

#include <cstdint>

#include "exec/Vector.hpp"

namespace gimdem
{

struct CellGrid
{
    Constant3 origin{0, 0, 0};  ///< [m]
    double cell_size = 1;       ///< [m]
    std::int32_t nx = 1, ny = 1, nz = 1;

    /// Grid over [low, high] with cubes of `cell_size` or, where that would make more than `most_cells`, larger ones.
    /// Along axes where `whole_cells` is not zero the box holds a whole number of cells, the last of which is longer
    /// where the length is no multiple of the cell size: what a periodic axis needs.
    static CellGrid over(Vec3 const& low, Vec3 const& high, double cell_size, std::int64_t most_cells,
                         Constant3 const& whole_cells = {0, 0, 0});

    GIMDEM_HD std::int64_t count() const { return static_cast<std::int64_t>(nx) * ny * nz; }

    /// Number of the cell that holds x; a point outside the box belongs to the nearest cell.
    GIMDEM_HD std::int32_t cell_of(Vec3 const& x) const
    {
        std::int32_t const cx = along(x.x() - origin.x, nx);
        std::int32_t const cy = along(x.y() - origin.y, ny);
        std::int32_t const cz = along(x.z() - origin.z, nz);
        return (cz * ny + cy) * nx + cx;
    }

    /// Number along one axis, of n cells, of the cell at `distance` [m] from the origin, or the nearest.
    GIMDEM_HD std::int32_t along(double distance, std::int32_t n) const
    {
        double const cell = distance / cell_size;
        if (!(cell > 0)) return 0;
        return cell >= n ? n - 1 : static_cast<std::int32_t>(cell);
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Boxes of space over the triangles of a wall: which triangles are within reach of each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exec/Vector.hpp"
#include "search/CellGrid.hpp"
#include "walls/WallView.hpp"

namespace gimdem
{

class TriangleBins
{
public:
    /// At least one triangle. `reach` [m]: how near a centre can be to a wall that it feels.
    TriangleBins(std::span<WallTriangle const> triangles, double reach);

    Vec3 low() const { return low_; }    ///< no particle outside of [low, high] feels the triangles [m]
    Vec3 high() const { return high_; }  ///< [m]
    CellGrid const& grid() const { return grid_; }
    /// Triangles of box c are members()[offsets()[c] .. offsets()[c + 1]), rising; shape=(grid().count() + 1,).
    std::span<std::int32_t const> offsets() const { return offsets_; }
    std::span<std::int32_t const> members() const { return members_; }

private:
    void fit_grid(std::span<WallTriangle const> triangles, double reach);

    Vec3 low_, high_;
    CellGrid grid_;
    std::vector<std::int32_t> offsets_, members_;
};

}  // namespace gimdem

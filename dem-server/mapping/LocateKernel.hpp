// SPDX-License-Identifier: BSD-3-Clause
/// Cell of a particle, theory.md (G.3), (G.3a).
#pragma once

#include <cstdint>

#include "mesh/PointLocator.hpp"

namespace gimdem
{

/// Goes from the last cell to the one that holds the particle now; status 1 where it left the mesh, 2 where it sank
/// into a wall.
struct LocateKernel
{
    CellFinder find;
    Quad const* position;
    std::uint8_t const* wall_faces;
    std::int32_t* cell_of;
    std::uint8_t* status;

    GIMDEM_HD void operator()(std::int64_t p) const { locate(p); }

    GIMDEM_HD Location locate(std::int64_t p) const
    {
        Quad const x = position[p];
        Location const at = find(cell_of[p], x.xyz());
        cell_of[p] = at.cell;
        bool const inside_a_wall = at.face >= find.mesh.internal_face_count && wall_faces[at.face] != 0;
        bool const between_cells = at.face >= 0 && at.face < find.mesh.internal_face_count;
        bool const outside = at.face >= 0 && !between_cells && !(inside_a_wall && at.outside < x.w);
        status[p] = static_cast<std::uint8_t>(outside ? (inside_a_wall ? 2 : 1) : 0);
        return at;
    }
};

}  // namespace gimdem

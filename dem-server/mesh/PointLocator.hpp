// SPDX-License-Identifier: BSD-3-Clause
/// Which cell holds a point: walk across faces from a nearby cell, then settle what is near warped faces or in cells
/// that are not convex, theory.md (G.3), (G.3a).
#pragma once

#include <cstdint>

#include "mesh/BoxGrid.hpp"
#include "mesh/CellSide.hpp"
#include "mesh/OneFace.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// Where a search ended.
struct Location
{
    std::int32_t cell;         ///< the cell that holds the point or, outside the mesh, the last one before the boundary
    double outside;            ///< how far the point is outside of that cell [m]; <= 0 inside
    std::int32_t face;         ///< the face it is outside of; -1 inside
    bool is_certain;           ///< it is behind all faces by more than they are warped: no other cell holds it
    bool is_enclosed = false;  ///< not certain, but found to be enclosed by the cell's faces
};

/// Walks from a start cell through the face that the point is farthest outside of. A walk that meets the boundary goes
/// on through any other violated face (re-entrant corners); one that runs in a circle (faces that are not planar, cells
/// that are not convex) ends at the cell with the least violation.
struct CellWalker
{
    MeshKernelView mesh;

    GIMDEM_HD Location operator()(std::int32_t start, Vec3 const& x) const
    {
        Location best{start, 1e300, -1, false};
        std::int32_t cell = start, mark = -1;
        for (int step = 0; step < most_steps; ++step)
        {
            std::int32_t next = -1;
            Location const here = look_from(cell, x, next);
            if (here.face < 0) return here;
            if (here.outside <= best.outside) best = here;
            if (next < 0 || next == mark) return best;
            // The mark moves less and less often, so that a circle of any length meets it.
            if ((step & (step - 1)) == 0) mark = cell;
            cell = next;
        }
        return best;
    }

    static constexpr int most_steps = 512;

private:
    /// How far x is outside of a cell; `next`: the cell across the worst of its internal faces, -1 if it is behind all.
    GIMDEM_HD Location look_from(std::int32_t cell, Vec3 const& x, std::int32_t& next) const
    {
        Location here{cell, 0, -1, true};
        double worst_internal = 0;
        for (std::int32_t k = mesh.cell_offsets[cell]; k < mesh.cell_offsets[cell + 1]; ++k)
        {
            std::int32_t const face = mesh.cell_faces[k];
            double const outside = mesh.distance_outside(face, cell, x);
            here.is_certain = here.is_certain && outside < -mesh.face_normal[face].w;
            if (outside > here.outside)
            {
                here.outside = outside;
                here.face = face;
            }
            if (outside > worst_internal && face < mesh.internal_face_count)
            {
                worst_internal = outside;
                next = mesh.across(face, cell);
            }
        }
        return here;
    }
};

/// The cell of a point whatever the shape of the cells, and the same one from whatever cell the search starts: the cell
/// whose faces, as fans of triangles, enclose it; on a face, an edge or a corner that of the lowest number (G.3a).
struct CellFinder
{
    MeshKernelView mesh;
    BoxGridView grid;

    /// `last`: where to begin, or -1.
    GIMDEM_HD Location operator()(std::int32_t last, Vec3 const& x) const
    {
        CellWalker const walk{mesh};
        Location const here = walk(last < 0 ? grid.near(x) : last, x);
        if (here.is_certain) return here;
        std::int32_t cell = near_one_face(here.cell, x);
        if (cell < 0) cell = enclosing_cell(here.cell, x);
        if (cell >= 0) return {cell, 0, -1, false, true};
        if (here.face < 0 || last < 0) return here;
        Location const other = walk(grid.near(x), x);
        return other.outside < here.outside ? other : here;
    }

private:
    /// The cell, or the one across the only face that x is near; -1 where that is not enough to know.
    GIMDEM_HD std::int32_t near_one_face(std::int32_t cell, Vec3 const& x) const
    {
        OneFace const one{mesh};
        OneFace::Result const result = one(cell, x);
        if (result.answer == OneFace::Answer::inside) return cell;
        if (result.answer == OneFace::Answer::unknown) return -1;
        std::int32_t const beside = mesh.across(result.face, cell);
        return beside >= 0 && one(beside, x).answer == OneFace::Answer::inside ? beside : -1;
    }

    /// -1 outside of the mesh. `likely` is looked at first.
    GIMDEM_HD std::int32_t enclosing_cell(std::int32_t likely, Vec3 const& x) const
    {
        if (CellSide{mesh}(likely, x) == Side::inside) return likely;
        std::int64_t const bin = grid.bin(x);
        for (std::int32_t m = grid.offsets[bin]; m < grid.offsets[bin + 1]; ++m)
        {
            std::int32_t const cell = grid.members[m];
            if (grid.boxes[cell].holds(x) && CellSide{mesh}(cell, x) != Side::outside) return cell;
        }
        return -1;
    }
};

}  // namespace gimdem

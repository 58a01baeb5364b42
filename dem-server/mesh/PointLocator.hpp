// SPDX-License-Identifier: BSD-3-Clause
/// Which cell holds a point: walk across faces from a nearby cell, theory.md (G.3).
#pragma once

#include <cstdint>
#include <vector>

#include "exec/Buffer.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// Where a walk ended.
struct Location
{
    std::int32_t cell;  ///< the cell that holds the point or, outside the mesh, the last one before the boundary
    double outside;     ///< how far the point is outside of that cell [m]; <= 0 inside
    std::int32_t face;  ///< the face it is outside of; -1 inside
};

/// Walks from a start cell through the face that the point is farthest outside of. A walk that meets the boundary goes
/// on through any other violated face (re-entrant corners); one that runs in a circle (faces that are not planar, cells
/// that are not convex) ends at the cell with the least violation.
struct CellWalker
{
    MeshKernelView mesh;

    GIMDEM_HD Location operator()(std::int32_t start, Vec3 const& x) const
    {
        Location best{start, 1e300, -1};
        std::int32_t cell = start;
        for (int step = 0; step < most_steps; ++step)
        {
            double worst = 0, worst_internal = 0;
            std::int32_t worst_face = -1, next = -1;
            for (std::int32_t k = mesh.cell_offsets[cell]; k < mesh.cell_offsets[cell + 1]; ++k)
            {
                std::int32_t const face = mesh.cell_faces[k];
                double const outside = mesh.distance_outside(face, cell, x);
                if (outside > worst)
                {
                    worst = outside;
                    worst_face = face;
                }
                if (outside > worst_internal && face < mesh.internal_face_count)
                {
                    worst_internal = outside;
                    next = mesh.across(face, cell);
                }
            }
            if (worst_face < 0) return {cell, 0, -1};
            if (worst <= best.outside) best = {cell, worst, worst_face};
            if (next < 0) return best;
            cell = next;
        }
        return best;
    }

    static constexpr int most_steps = 512;
};

/// A start cell for any point: a grid over the mesh whose boxes know a cell near their middle.
class StartCells
{
public:
    explicit StartCells(PolyMesh const& mesh);
    std::int32_t near(Vec3 const& x) const;

private:
    Vec3 low_, box_;
    std::int32_t n_[3];
    std::vector<std::int32_t> cell_;
};

}  // namespace gimdem

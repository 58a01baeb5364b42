// SPDX-License-Identifier: BSD-3-Clause
/// How far a particle may move before its cell has to be looked for again, theory.md (G.3c).
#pragma once

#include <cmath>
#include <cstdint>

#include "mapping/LocateKernel.hpp"
#include "mesh/FaceFan.hpp"
#include "mesh/PolyMesh.hpp"
#include "walls/Triangle.hpp"

namespace gimdem
{

/// A distance from a point inside a cell that no face of the cell is nearer than [m].
struct SurfaceDistance
{
    MeshKernelView mesh;
    bool with_triangles = true;  ///< else it is 0 next to a warped face: that is quicker

    double operator()(std::int32_t cell, Vec3 const& x) const
    {
        double least = 1e300;
        for (std::int32_t k = mesh.cell_offsets[cell]; k < mesh.cell_offsets[cell + 1]; ++k)
        {
            std::int32_t const face = mesh.cell_faces[k];
            // A face is within its warp of its plane.
            double const beyond = std::abs(mesh.distance_outside(face, cell, x)) - mesh.face_normal[face].w;
            if (!(beyond > 0) && !with_triangles) return 0;
            double const distance = beyond > 0 ? beyond : to_triangles(face, x);
            least = distance < least ? distance : least;
        }
        return least;
    }

private:
    double to_triangles(std::int32_t face, Vec3 const& x) const
    {
        FaceFan const fan(mesh, face, x);
        Vec3 const origin(0, 0, 0);
        Vec3 a = fan.corner(fan.end - 1);
        double least2 = 1e300;
        for (std::int32_t k = fan.begin; k < fan.end; ++k)
        {
            Vec3 const b = fan.corner(k);
            double const distance2 = closest_on_triangle(a, b, fan.middle, origin).point.squaredNorm();
            least2 = distance2 < least2 ? distance2 : least2;
            a = b;
        }
        return std::sqrt(least2);
    }
};

/// LocateKernel, but for particles that have not gone far enough to leave the cell where they were found last.
struct LocateMovedKernel
{
    LocateKernel anew;
    Quad* sure;  ///< where each particle was found last, w: how far it may be from there [m]; negative: nowhere

    void operator()(std::int64_t p) const
    {
        Quad const x = anew.position[p];
        anew.status[p] = 0;
        double const way2 = (x.xyz() - sure[p].xyz()).squaredNorm();
        if (sure[p].w > 0 && way2 < sure[p].w * sure[p].w) return;
        Location const at = anew.locate(p);
        sure[p] = Quad::of(x.xyz(), at.is_certain || at.is_enclosed ? sure_distance(at.cell, x.xyz(), way2) : -1);
    }

private:
    /// A tenth stays for rounding, and who is next to a face is looked at each time. The cell encloses x. Distances to
    /// triangles pay for particles that are slow: `way2` is the square of the way since the last search.
    double sure_distance(std::int32_t cell, Vec3 const& x, double way2) const
    {
        MeshKernelView const& mesh = anew.find.mesh;
        double const size = std::cbrt(mesh.cell[cell].w);
        double const distance = SurfaceDistance{mesh, way2 < 1e-4 * size * size}(cell, x);
        return distance > 1e-5 * size ? 0.9 * distance : -1;
    }
};

}  // namespace gimdem

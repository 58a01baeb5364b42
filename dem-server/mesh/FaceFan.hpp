// SPDX-License-Identifier: BSD-3-Clause
/// A face as the fan of triangles around the mean of its points, theory.md (G.1).
#pragma once

#include <cstdint>

#include "exec/Vector.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// Triangles (corner(k - 1), corner(k), middle) for k from begin to end, the first one's corner(begin - 1) being
/// corner(end - 1); all as seen from a point, which is the origin.
struct FaceFan
{
    MeshKernelView const& mesh;
    Vec3 from;
    std::int32_t begin, end;
    Vec3 middle;

    GIMDEM_HD FaceFan(MeshKernelView const& mesh_, std::int32_t face, Vec3 const& x)
        : mesh(mesh_), from(x), begin(mesh_.face_offsets[face]), end(mesh_.face_offsets[face + 1]), middle(0, 0, 0)
    {
        for (std::int32_t k = begin; k < end; ++k)
            middle += point(k);
        middle = middle / (end - begin) - from;
    }

    GIMDEM_HD Vec3 corner(std::int32_t k) const { return point(k) - from; }

private:
    GIMDEM_HD Vec3 point(std::int32_t k) const
    {
        double const* const x = mesh.points + 3 * std::int64_t{mesh.face_points[k]};
        return {x[0], x[1], x[2]};
    }
};

}  // namespace gimdem

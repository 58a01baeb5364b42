// SPDX-License-Identifier: BSD-3-Clause
/// Whether a cell encloses a point that is near one of its warped faces and far from the others, theory.md (G.3b):
/// what is usual, and quicker than the solid angles of all faces.
#pragma once

#include <cmath>
#include <cstdint>

#include "exec/Vector.hpp"
#include "mesh/FaceFan.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

struct OneFace
{
    enum class Answer : std::int8_t
    {
        unknown,
        outside,
        inside
    };
    struct Result
    {
        Answer answer;
        std::int32_t face;  ///< the one that the point is near
    };

    MeshKernelView mesh;

    GIMDEM_HD Result operator()(std::int32_t cell, Vec3 const& x) const
    {
        std::int32_t const face = only_near_face(cell, x);
        if (face < 0) return {Answer::unknown, -1};
        // From a place that the cell encloses for sure, straight along the face's normal to the point.
        double const height = mesh.distance_outside(face, cell, x);
        double const way = height + mesh.face_normal[face].w;
        for (std::int32_t k = mesh.cell_offsets[cell]; k < mesh.cell_offsets[cell + 1]; ++k)
        {
            std::int32_t const other = mesh.cell_faces[k];
            if (other == face) continue;
            if (mesh.distance_outside(other, cell, x) + way >= -mesh.face_normal[other].w)
                return {Answer::unknown, face};
        }
        return {crossings(face, x, mesh.owner[face] == cell ? 1 : -1), face};
    }

private:
    /// -1 where there are none or several.
    GIMDEM_HD std::int32_t only_near_face(std::int32_t cell, Vec3 const& x) const
    {
        std::int32_t found = -1;
        for (std::int32_t k = mesh.cell_offsets[cell]; k < mesh.cell_offsets[cell + 1]; ++k)
        {
            std::int32_t const face = mesh.cell_faces[k];
            if (mesh.distance_outside(face, cell, x) < -mesh.face_normal[face].w) continue;
            if (found >= 0) return -1;
            found = face;
        }
        return found;
    }

    /// Parity of the triangles of a face below x along the normal out of the cell. Too close to an edge or a triangle
    /// it is unknown.
    GIMDEM_HD Answer crossings(std::int32_t face, Vec3 const& x, double side) const
    {
        FaceFan const fan(mesh, face, x);
        Vec3 const n = side * mesh.face_normal[face].xyz();
        double const rounding = 1e-10 * mesh.face_centre[face].w;
        Vec3 const m = fan.middle;
        Vec3 a = fan.corner(fan.end - 1);
        bool crossed = false;
        for (std::int32_t k = fan.begin; k < fan.end; ++k)
        {
            Vec3 const b = fan.corner(k);
            // Twice the areas of the three parts that x cuts the triangle into, seen along n.
            double const ab = n.dot(a.cross(b)), bm = n.dot(b.cross(m)), ma = n.dot(m.cross(a));
            double const whole = ab + bm + ma;
            double const s = whole < 0 ? -1 : 1;
            double const least = least_of(s * ab, s * bm, s * ma);
            if (std::abs(least) <= rounding) return Answer::unknown;
            if (least > 0)
            {
                double const height = (bm * a + ma * b + ab * m).dot(n);  // times whole
                if (std::abs(height) <= 1e-10 * std::abs(whole) * std::sqrt(mesh.face_centre[face].w))
                    return Answer::unknown;
                crossed = crossed != (s * height < 0);
            }
            a = b;
        }
        return crossed ? Answer::outside : Answer::inside;
    }

    GIMDEM_HD static double least_of(double a, double b, double c)
    {
        double const least = a < b ? a : b;
        return least < c ? least : c;
    }
};

}  // namespace gimdem

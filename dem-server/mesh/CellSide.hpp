// SPDX-License-Identifier: BSD-3-Clause
/// Whether a cell of any shape encloses a point, by the solid angles of its faces, theory.md (G.3a).
#pragma once

#include <cmath>
#include <cstdint>

#include "exec/Vector.hpp"
#include "mesh/FaceFan.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

enum class Side : std::int8_t
{
    outside,
    on,  ///< a face, edge or corner, to rounding
    inside
};

/// Which side of a cell's surface, its faces taken as fans of triangles (G.1), a point is on.
struct CellSide
{
    MeshKernelView mesh;

    GIMDEM_HD Side operator()(std::int32_t cell, Vec3 const& x) const
    {
        double half_angle = 0;
        bool is_on = false;
        for (std::int32_t k = mesh.cell_offsets[cell]; k < mesh.cell_offsets[cell + 1]; ++k)
        {
            std::int32_t const face = mesh.cell_faces[k];
            double const angle = half_solid_angle(face, x, is_on);
            half_angle += mesh.owner[face] == cell ? angle : -angle;
        }
        if (is_on) return Side::on;
        constexpr double pi = 3.141592653589793;  // half the full angle is 2 pi
        return half_angle > pi ? Side::inside : Side::outside;
    }

private:
    /// Of a face seen from x; positive where its normal points away from x. [1]
    GIMDEM_HD double half_solid_angle(std::int32_t face, Vec3 const& x, bool& is_on) const
    {
        FaceFan const fan(mesh, face, x);
        Vec3 const m = fan.middle;
        double const length_m = m.norm();
        Vec3 a = fan.corner(fan.end - 1);
        double length_a = a.norm(), angle = 0;
        for (std::int32_t k = fan.begin; k < fan.end; ++k)
        {
            Vec3 const b = fan.corner(k);
            double const length_b = b.norm(), cube = length_a * length_b * length_m;
            // van Oosterom and Strackee's tangent of half the angle of a triangle.
            double const sine = a.dot(b.cross(m));
            double const cosine = cube + a.dot(b) * length_m + b.dot(m) * length_a + m.dot(a) * length_b;
            is_on = is_on || (std::abs(sine) <= rounding * cube && cosine <= rounding * cube);
            angle += std::atan2(sine, cosine);
            a = b;
            length_a = length_b;
        }
        return angle;
    }

    static constexpr double rounding = 1e-12;
};

}  // namespace gimdem

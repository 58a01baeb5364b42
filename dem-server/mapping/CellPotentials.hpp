// SPDX-License-Identifier: BSD-3-Clause
/// A potential of each cell, a polynomial of degree two, theory.md (G.34): the cell whose potential is least at a point
/// holds it, and the potentials of two neighbours differ by the signed distance to their face.
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// Q(x) = value + y.gradient + y.H y / 2, y = x - centre. Two cache lines.
struct alignas(64) CellPotential
{
    double centre[3];        ///< centroid of the cell [m]
    double value;            ///< at the centre [m]
    double gradient[3];      ///< at the centre [1]
    double narrowness;       ///< |H|^2 / 10: 0.3 / a^2 for a cube of edge a [1/m^2]
    double half_hessian[6];  ///< H / 2: xx, yy, zz and twice yz, xz, xy [1/m]
    double unused[2];

    GIMDEM_HD double operator()(Quad const& at) const
    {
        double const x = at.x - centre[0], y = at.y - centre[1], z = at.z - centre[2];
        double const along_x = gradient[0] + half_hessian[0] * x + half_hessian[5] * y;
        double const along_y = gradient[1] + half_hessian[1] * y + half_hessian[3] * z;
        double const along_z = gradient[2] + half_hessian[2] * z + half_hessian[4] * x;
        return value + x * along_x + y * along_y + z * along_z;
    }
};

/// Fits the potentials of all cells, (G.36)-(G.37). Depends on the mesh alone.
exec::Buffer<CellPotential> fit_potentials(PolyMesh const& mesh);

}  // namespace gimdem

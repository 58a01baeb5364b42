// SPDX-License-Identifier: BSD-3-Clause
/// Whether a mesh that is sound in its numbers is one in space: cells closed, volumes positive.
#pragma once

#include <string>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::conformance
{

struct MeshGeometry
{
    std::vector<double> volumes;  ///< of each cell [m^3]
    double opening = 0;           ///< of the worst cell: sum of its face areas over the sum of their magnitudes [1]
    int most_open_cell = 0;
    int smallest_cell = 0;
};

/// Faces are fans of triangles about the mean of their points.
MeshGeometry measure(coupling::Mesh const& mesh);

/// Empty if particles can be mapped onto it.
std::string find_fault(MeshGeometry const& geometry);

}  // namespace gimdem::conformance

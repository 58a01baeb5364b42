// SPDX-License-Identifier: BSD-3-Clause
/// Meshes as OpenFOAM keeps them: the files points, faces, owner, neighbour and boundary of a folder polyMesh, as text.
#pragma once

#include <filesystem>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::test
{

/// Reads a folder that holds the five files, or one that has them in constant/polyMesh. Throws UserError with file and
/// line for a file that is absent, binary or not what it should be.
coupling::Mesh read_poly_mesh(std::filesystem::path folder);

}  // namespace gimdem::test

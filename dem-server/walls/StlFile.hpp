// SPDX-License-Identifier: BSD-3-Clause
/// Triangulated surfaces from files, read by Assimp.
#pragma once

#include <filesystem>

#include "walls/SurfaceMesh.hpp"

namespace gimdem
{

/// The triangles of an ASCII or binary STL file, all its solids together, `scale` metres per unit of the file. Corners
/// with the same coordinates become one point; nothing else is changed. Throws UserError where the file is missing,
/// empty or not STL.
SurfaceMesh read_stl(std::filesystem::path const& file, double scale);

}  // namespace gimdem

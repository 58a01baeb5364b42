// SPDX-License-Identifier: BSD-3-Clause
/// Topological sense of a mesh: what must hold before any index of it is followed.
#pragma once

#include <optional>
#include <string>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling::message
{

/// The first thing wrong with the mesh, in words; empty if counts, offsets, indices and patches are consistent and the
/// points finite. Geometry (volumes, planarity) is not looked at.
std::optional<std::string> find_mesh_fault(MeshView const& mesh);

}  // namespace gimdem::coupling::message

// SPDX-License-Identifier: BSD-3-Clause
/// Mesh and MeshAccepted.
#pragma once

#include <cstdint>

#include "gimdem/coupling/Types.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

/// Fault::user if the mesh is inconsistent.
Message pack(MeshView const& mesh);
Message pack_mesh_accepted(std::int32_t cell_count);

/// A copy that the receiver owns. Fault::protocol if the mesh is inconsistent.
Mesh unpack_mesh(Message const& message);
/// Fault::protocol unless it counts as many cells as were sent.
void check_mesh_accepted(Message const& message, std::int32_t cell_count);

/// The same mesh by reference.
MeshView view_of(Mesh const& mesh);

}  // namespace gimdem::coupling::message

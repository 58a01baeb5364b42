// SPDX-License-Identifier: BSD-3-Clause
/// One mesh from the parts that the ranks of a client have.
#pragma once

#include <cstdint>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling::message
{

struct MergedMesh
{
    Mesh mesh;
    std::vector<std::int32_t> first_cell;  ///< shape=(ranks + 1,): cell c of rank r is cell first_cell[r] + c
};

/// The whole mesh. Points and faces that ranks share are there once; internal faces lie in the order of (owner,
/// neighbour); boundary patches of one name are joined, the ranks' faces one after the other; processor patches are
/// gone. It depends on nothing but the parts and their order.
///
/// Fault::mesh, naming rank and patch, if the parts do not fit together.
/// @pre each part has passed find_mesh_fault().
MergedMesh merge_meshes(std::vector<Mesh> const& parts);

}  // namespace gimdem::coupling::message

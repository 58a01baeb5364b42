// SPDX-License-Identifier: BSD-3-Clause
/// The mesh of the scripted client, whole and in ranks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "BoxMesh.hpp"
#include "MeshParts.hpp"

namespace gimdem::test
{

inline constexpr std::uint64_t run_number = 4711;  ///< of all its runs of several ranks

/// 1024 cells: vector fields are large enough for shared memory.
inline coupling::Mesh scripted_mesh()
{
    return BoxMesh::make({8, 8, 16}, {0.06, 0.06, 0.12});
}

/// In slabs of two layers of cells, dealt to the ranks in turn.
inline coupling::Mesh part_of_scripted_mesh(coupling::Rank const& rank)
{
    coupling::Mesh const whole = scripted_mesh();
    if (rank.count == 1) return whole;
    return cut(whole, dealt(whole.cell_count, rank.count, 2 * 8 * 8)).parts[static_cast<std::size_t>(rank.number)];
}

}  // namespace gimdem::test

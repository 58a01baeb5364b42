// SPDX-License-Identifier: BSD-3-Clause
/// What the mesh has of the particles at the end of a coupling step: part of a checkpoint, theory.md (C.20).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gimdem/coupling/Types.hpp"
#include "output/Snapshot.hpp"

namespace gimdem
{

/// It cannot be made again from the particles: some have left since they were mapped, and the drag was that of the
/// step.
struct MappedState
{
    std::string mesh;                                     ///< mesh_hash() of the mesh that it belongs to
    std::vector<std::int32_t> cell_of;                    ///< shape=(n_particles,)
    std::vector<double> void_fraction, drag_coefficient;  ///< shape=(n_cells,) [1], [kg/(m^3 s)]
    std::vector<double> momentum_source, drag_momentum;   ///< shape=(n_cells, 3) [N/m^3]

    bool fits(std::int64_t particles, std::int32_t cells) const;
};

/// Equal for equal points, faces and patches.
std::string mesh_hash(coupling::Mesh const& mesh);

void add_mapped(output::SnapshotWriter& writer, MappedState const& mapped);
/// Empty, with no mesh, where the snapshot has none.
MappedState mapped_of(output::SnapshotReader const& reader);

}  // namespace gimdem

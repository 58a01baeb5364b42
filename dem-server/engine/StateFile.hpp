// SPDX-License-Identifier: BSD-3-Clause
/// The particles of a system, with their contact history, in a snapshot: exact to the bit.
#pragma once

#include "engine/DemSystem.hpp"
#include "output/Snapshot.hpp"

namespace gimdem
{

/// Adds positions, velocities, spins, forces, materials, ids, the springs of contacts with particles and walls, and
/// where the particles were when their neighbour list was built. The list itself follows from that.
void add_state(output::SnapshotWriter& writer, DemSystem const& system);

/// Puts the particles and springs of a snapshot in place of the system's own, however many they are. Throws UserError,
/// with the system as it was, where arrays do not fit each other; `materials` is how many the case has.
void take_state(output::SnapshotReader const& reader, int materials, DemSystem& system);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Where particles were when their weights were computed, in a snapshot: exact to the bit.
#pragma once

#include "mapping/WeightReuse.hpp"
#include "output/Snapshot.hpp"

namespace gimdem
{

void add_reference(output::SnapshotWriter& writer, WeightReference const& reference);

/// Throws UserError where the arrays do not fit the particles of the snapshot.
WeightReference reference_of(output::SnapshotReader const& reader);

}  // namespace gimdem

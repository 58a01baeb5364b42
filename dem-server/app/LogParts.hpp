// SPDX-License-Identifier: BSD-3-Clause
/// What the logs of runs with and without a fluid have in common.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "engine/DemSystem.hpp"
#include "gimdem/coupling/Server.hpp"
#include "output/Summary.hpp"

namespace gimdem::app
{

/// Wall time since then [s].
double seconds_since(std::chrono::steady_clock::time_point start);

/// xyz of quads as n * 3 doubles.
std::vector<double> triples(exec::Buffer<Quad> const& quads);

/// All particles that left, whatever the cause.
Removed total_removed(DemSystem const& system);

/// particles_removed, particles_lost and mass_removed.
void add_removed(DemSystem const& system, output::Summary& summary);
/// One figure for each cause: removed_through_NAME.
void add_removed_by_cause(DemSystem const& system, output::Summary& summary);

/// What the client tells of its last step under that name; NaN if it does not.
double monitor(coupling::FluidState const& fluid, std::string const& name);

}  // namespace gimdem::app

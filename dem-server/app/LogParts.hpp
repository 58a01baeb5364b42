// SPDX-License-Identifier: BSD-3-Clause
/// What the logs of runs with and without a fluid have in common.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "engine/DemSystem.hpp"
#include "gimdem/coupling/Server.hpp"
#include "output/Summary.hpp"
#include "output/VtkParticles.hpp"

namespace gimdem::app
{

/// Wall time since then [s].
double seconds_since(std::chrono::steady_clock::time_point start);

/// Calls write(frame) with all particles as a ParaView file shows them at `time` [s].
void with_particle_frame(ParticleState const& particles, double time,
                         std::function<void(output::ParticleFrame const&)> const& write);

/// All particles that left, whatever the cause.
Removed total_removed(DemSystem const& system);

/// particles_removed, particles_lost and mass_removed.
void add_removed(DemSystem const& system, output::Summary& summary);
/// One figure for each cause: removed_through_NAME.
void add_removed_by_cause(DemSystem const& system, output::Summary& summary);

/// What the client tells of its last step under that name; NaN if it does not.
double monitor(coupling::FluidState const& fluid, std::string const& name);

}  // namespace gimdem::app

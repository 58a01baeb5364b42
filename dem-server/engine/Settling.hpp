// SPDX-License-Identifier: BSD-3-Clause
/// The bed before the fluid starts: settled once by DEM alone, then kept in a file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/Case.hpp"
#include "engine/DemSystem.hpp"

namespace gimdem
{

/// Called now and then while the bed settles with the time [s] and the mean kinetic energy per particle [J]; returning
/// false ends the settling with a UserError.
using SettlingReport = std::function<bool(double time, double kinetic_energy)>;

/// Mean kinetic energy per particle, translation and rotation [J].
double mean_kinetic_energy(exec::Execution execution, ParticleState const& particles);

/// Steps the system until [settle] is satisfied; returns the time it took [s].
double settle(Case const& settings, exec::Execution execution, DemSystem& system, SettlingReport const& report);

/// Name of the file that would hold the bed of this case and these walls: settled/<hash of all that decides it>.h5.
std::filesystem::path settled_bed_file(Case const& settings, WallGeometry const& walls, PolyMesh const& mesh);

/// State of a system with its contact springs, exact to the bit; whole or not at all. `kind` is checked on reading.
void write_state(std::filesystem::path const& file, std::string const& kind, DemSystem const& system, double time);

/// Particles and springs of a file, in place of the system's own. Throws UserError for a file that is not whole or does
/// not belong to this system's number of particles.
void read_state(std::filesystem::path const& file, std::string const& kind, DemSystem& system);

}  // namespace gimdem

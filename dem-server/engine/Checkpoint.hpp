// SPDX-License-Identifier: BSD-3-Clause
/// Checkpoints: all that the particle side needs to go on as if it had never stopped, theory.md (D.68).
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "core/Case.hpp"
#include "engine/DemSystem.hpp"
#include "engine/MappedState.hpp"
#include "mapping/WeightReuse.hpp"
#include "particles/Inlet.hpp"

namespace gimdem
{

/// Version of what a checkpoint holds; a reader accepts its own only.
inline constexpr std::int64_t checkpoint_version = 2;

/// Where a run is.
struct RunPoint
{
    std::int64_t step = 0;  ///< time steps so far: of the DEM in a run without a fluid, else coupling steps
    double time = 0;        ///< [s]
};

/// Writes the checkpoint, whole or not at all, with the references of weights that are reused and, in a coupled run,
/// what is mapped. The run goes on as if nothing had been written.
void write_checkpoint(std::filesystem::path const& file, Case const& settings, RunPoint const& point,
                      std::vector<Inlet> const& inlets, DemSystem const& system, WeightReuse const* reuse = nullptr,
                      MappedState const* mapped = nullptr);

/// Puts a checkpoint in place of the state of a system, the inlets and the references that were made from the same
/// case. Throws UserError for a file that is cut short, changed, of another version or of another case; nothing is
/// changed then. `mapped` becomes what the file has of it.
RunPoint read_checkpoint(std::filesystem::path const& file, Case const& settings, std::vector<Inlet>& inlets,
                         DemSystem& system, WeightReuse* reuse = nullptr, MappedState* mapped = nullptr);

/// Throws UserError for a run that would end at `until` [s], where its checkpoint is, or before.
void require_time_left(std::filesystem::path const& file, RunPoint const& point, double until);

/// checkpoints/step_000000123_at_0.00123.h5 in a run folder: the step, and the time [s] for whoever looks for it.
std::filesystem::path checkpoint_file(std::filesystem::path const& folder, RunPoint const& point);

/// The checkpoint of this step in a run folder; empty: there is none.
std::optional<std::filesystem::path> find_checkpoint(std::filesystem::path const& folder, std::int64_t step);

/// Removes the oldest checkpoints of a run folder: all but the three newest, and none of `complete_step` or later,
/// which is the newest one to which the other solver has its fields whole (0: none yet).
void keep_newest_checkpoints(std::filesystem::path const& folder,
                             std::int64_t complete_step = std::numeric_limits<std::int64_t>::max());

}  // namespace gimdem

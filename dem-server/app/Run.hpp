// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "core/Case.hpp"
#include "output/StepTrace.hpp"

namespace gimdem::app
{

/// A whole run: wait for a client, take its mesh, settle or load the bed, couple until the client says goodbye. Results
/// and checkpoints go to `folder`. With `restart`, it goes on from that checkpoint instead of a bed. `trace`: how much
/// of the run goes to trace.json. Throws UserError or coupling::CouplingError; the client is told why before either
/// leaves.
void run(Case const& settings, std::filesystem::path const& folder, std::optional<std::filesystem::path> const& restart,
         output::TraceChoice const& trace);

/// From now on Ctrl-C asks for an orderly end; before, as while waiting for a client, it ends the process at once.
void heed_interrupts();
/// As before heed_interrupts().
void die_of_interrupts();
/// True once the user asked for the end (Ctrl-C).
bool interrupted();

}  // namespace gimdem::app

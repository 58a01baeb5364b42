// SPDX-License-Identifier: BSD-3-Clause
/// Particles without a fluid: the server alone, in the box of [domain].
#pragma once

#include <filesystem>
#include <optional>

#include "core/Case.hpp"

namespace gimdem::app
{

/// The whole life of a run whose client is "none"; results and checkpoints go to `folder`. With `restart`, it goes on
/// from that checkpoint. Throws UserError for a fault.
void run_alone(Case const& settings, std::filesystem::path const& folder,
               std::optional<std::filesystem::path> const& restart);

}  // namespace gimdem::app

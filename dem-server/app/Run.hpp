// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "core/Case.hpp"

namespace gimdem::app
{

/// A whole run: wait for a client, take its mesh, settle or load the bed, couple until the client says goodbye. Results
/// go to `folder`. Throws UserError or coupling::CouplingError; the client is told why before either leaves.
void run(Case const& settings, std::filesystem::path const& folder);

/// True once the user asked for the end (Ctrl-C).
bool interrupted();

}  // namespace gimdem::app

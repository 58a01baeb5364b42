// SPDX-License-Identifier: BSD-3-Clause
/// All trials of a client: the lines of the table.
#pragma once

#include <functional>
#include <vector>

#include "conformance/Trial.hpp"

namespace gimdem::conformance
{

/// Runs them one after the other; script: its end time, axis and fields are those of every session. Each line is told
/// as soon as it is known.
void try_client(TrialOptions const& options, Script const& script, std::function<void(Finding const&)> const& tell);

}  // namespace gimdem::conformance

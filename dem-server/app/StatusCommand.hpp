// SPDX-License-Identifier: BSD-3-Clause
/// gimdem-server --status ENDPOINT: asks another server how its run stands.
#pragma once

#include <string>

#include "gimdem/coupling/Status.hpp"

namespace gimdem::app
{

/// For people: a few lines.
std::string status_text(coupling::Status const& status);
/// For programs: one JSON object in a line; a number that is not known is null.
std::string status_json(coupling::Status const& status);

/// Prints the status of the server at that endpoint, waiting for it so long at most [s]. keys: a folder, or empty.
void print_status(std::string const& endpoint, double timeout, std::string const& keys, bool as_json);

}  // namespace gimdem::app

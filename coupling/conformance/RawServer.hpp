// SPDX-License-Identifier: BSD-3-Clause
/// Servers that break the protocol itself, which the library cannot: messages written by hand.
#pragma once

#include "conformance/Findings.hpp"
#include "conformance/MockServer.hpp"

namespace gimdem::conformance
{

/// Misbehaviour::wrong_version or truncate; then waits until the client has gone, or has said why it ends.
bool play_raw(Script const& script, FindingsFile& findings);

}  // namespace gimdem::conformance

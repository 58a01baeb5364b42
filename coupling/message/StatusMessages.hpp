// SPDX-License-Identifier: BSD-3-Clause
/// StatusRequest and Status.
#pragma once

#include <string>

#include "gimdem/coupling/Status.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

/// A question has one frame, and this is more than it needs [byte].
inline constexpr std::size_t max_question_bytes = 1024;

Message pack_status_request(std::string const& name);
Message pack(Status const& status);

/// Texts are cut to what a log can print. Fault::protocol for more figures than a FluidState may have monitors.
Status unpack_status(Message const& message);

}  // namespace gimdem::coupling::message

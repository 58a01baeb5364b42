// SPDX-License-Identifier: BSD-3-Clause
/// Heartbeat, Error and Goodbye: the messages about the session itself.
#pragma once

#include <cstdint>
#include <string>

#include "message/Message.hpp"

namespace gimdem::coupling::message
{

struct Heartbeat
{
    std::string name;            ///< of the sender
    std::string state;           ///< of the sender
    std::int64_t step = 0;       ///< where the sender is
    std::uint64_t progress = 0;  ///< changes of state so far
    double timeout = 0;          ///< of the sender [s]
};

struct ErrorReport
{
    Fault fault = Fault::peer;
    std::string reason;
    std::string state;      ///< of the sender
    std::string name;       ///< of the sender
    std::int64_t step = 0;  ///< where the sender was
};

Message pack(Heartbeat const& heartbeat);
Message pack(ErrorReport const& report);
Message pack_goodbye(std::string const& reason);

/// Fault::protocol if its time-out is below min_timeout.
Heartbeat unpack_heartbeat(Message const& message);
ErrorReport unpack_error(Message const& message);
std::string unpack_goodbye(Message const& message);

}  // namespace gimdem::coupling::message

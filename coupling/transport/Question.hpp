// SPDX-License-Identifier: BSD-3-Clause
/// One message to a server, and its answer: no session, no thread, no heartbeat.
#pragma once

#include <optional>
#include <string>

#include "transport/Frames.hpp"
#include "transport/Keys.hpp"

namespace gimdem::coupling::transport
{

/// What came of a question.
struct Reply
{
    enum class Silence
    {
        nobody,       ///< nobody listens at the address
        not_zeromq,   ///< somebody does, but does not speak ZeroMQ
        locked_out,   ///< the server does not let our key in, or wants one
        hung_up,      ///< the connection ended without an answer
        no_answer,    ///< the time was up, on a connection that stands
        no_greeting,  ///< the time was up, before ZeroMQ's own handshake was over
    };
    Frames frames;                         ///< the answer
    Silence silence = Silence::no_answer;  ///< why there is none, if frames is empty
};

/// Waits so many seconds at most. Fault::endpoint for an address that is not allowed.
Reply ask(std::string const& endpoint, Frames question, double timeout, std::optional<ClientKeys> const& keys);

}  // namespace gimdem::coupling::transport

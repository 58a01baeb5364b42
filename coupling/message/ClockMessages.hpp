// SPDX-License-Identifier: BSD-3-Clause
/// What messages tell of clocks: docs/protocol.md, Clocks.
#pragma once

#include <cstdint>
#include <optional>

#include "gimdem/coupling/StepTimes.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

/// A reading of the sender's clock [s].
struct ClockReading
{
    double received = 0;        ///< when the message that this one answers arrived; 0: it answers none [s]
    double sent = 0;            ///< [s]
    double origin = 0;          ///< of a server: when the run began [s]
    std::uint64_t machine = 0;  ///< 0: not known
};

/// The first 64 bits of the boot id, which processes of one machine share until its next start; 0 if there is none.
std::uint64_t machine_number();

/// Into Hello, Welcome or SolidState.
void put(ClockReading const& reading, Message& message);
/// Empty if the peer leaves it out, as protocol 1.0 does. Fault::protocol for numbers that are not finite.
std::optional<ClockReading> clock_reading(Message const& message);

/// Into FluidState: the stations of the client's previous step, and the offset.
void put(ClientTimes const& times, ClockOffset const& offset, v1::StepTimes& body);
ClientTimes unpack_times(v1::StepTimes const& body);
ClockOffset unpack_offset(v1::StepTimes const& body);

/// Of a Goodbye; empty if the client leaves it out.
std::optional<LastClientStep> unpack_last_step(Message const& message);

}  // namespace gimdem::coupling::message

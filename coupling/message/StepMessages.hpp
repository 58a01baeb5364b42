// SPDX-License-Identifier: BSD-3-Clause
/// FluidState and SolidState.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "gimdem/coupling/Server.hpp"
#include "gimdem/coupling/Types.hpp"
#include "message/Fields.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

/// The server's answer to one step.
struct SolidState
{
    SolidFields fields;
    Timings timings;
    double busy_time = 0;  ///< from the arrival of the fluid to the answer, without unpacking [s]
    std::optional<std::string> stop_request;
    StepCells cells = {};  ///< as received, cells.needed only
};

/// What both sides agreed on: which fields travel, on how many cells.
struct Terms
{
    FieldChoice<FluidFields> fluid;
    FieldChoice<SolidFields> solid;
    std::size_t cell_count = 0;
    transport::SendMemory memory;     ///< of the fields that we send
    FieldStore store;                 ///< of the fields that we receive
    Encodings encodings;              ///< in force
    std::vector<NeededCells> needed;  ///< of the next fluid, as the server told last
};

/// A message whose fields fill() copies. Fault::user if a field has the wrong size, or a number cannot be sent.
Message lay_out(FluidState const& state, Terms const& terms);
Message lay_out(SolidState const& state, Terms const& terms);

/// The same with its fields. Fault::user also if one of their numbers cannot be sent.
template <class State>
Message pack(State const& state, Terms const& terms)
{
    Message message = lay_out(state, terms);
    fill(message);
    return message;
}

Message pack_fluid_wanted();

/// Fault::protocol if anything is missing, has the wrong size, or is not finite, or travels in a way that is not in
/// force. Spans live as long as the message, and until the next one is unpacked.
FluidState unpack_fluid_state(Message const& message, Terms const& terms);
SolidState unpack_solid_state(Message const& message, Terms const& terms);

}  // namespace gimdem::coupling::message

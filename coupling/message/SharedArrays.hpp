// SPDX-License-Identifier: BSD-3-Clause
/// Arrays in shared memory, and what messages say about it: docs/protocol.md, Shared memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "message/Message.hpp"
#include "transport/SharedMemory.hpp"

namespace gimdem::coupling::message
{

/// The last array of the message lies in our segment, there: its frame will travel empty.
void mark_shared(Message& message, std::uint64_t offset);

/// Points the empty frames of shared arrays at the peer's memory. Fault::protocol if there is none or one lies outside.
/// The frames live as long as the memory does.
void attach_shared(Message& message, transport::Mapping const* memory);

/// The bytes of all arrays as they travel, wherever they lie; the headers must have been checked.
std::size_t array_bytes(Message const& message);

/// Hello and Welcome: the sender can use shared memory and wants to.
void offer_shared_memory(Message& message);
bool offers_shared_memory(Message const& message);
bool offers_mailbox(Message const& message);

/// May this message go through a mailbox: the fields of a step, all of them shared?
bool may_be_posted(Message const& message);

/// Mesh and MeshAccepted: the sender's segment; an empty notice if it has none.
void announce_segment(Message& message, transport::SegmentNotice const& notice);
transport::SegmentNotice announced_segment(Message const& message);

/// MeshAccepted and FluidState: the sender reads the segment of its peer.
void confirm_segment(Message& message);
bool confirms_segment(Message const& message);

}  // namespace gimdem::coupling::message

// SPDX-License-Identifier: BSD-3-Clause
/// Between a Message and the frames on the wire, docs/protocol.md.
#pragma once

#include "message/Message.hpp"

namespace gimdem::coupling::message
{

/// Stamps our protocol version and writes the envelope. Fault::user if it or an array is too large.
transport::Frame encode_envelope(Message& message);

/// The same in front of the arrays.
transport::Frames encode(Message message);

/// Reads the envelope and checks everything that does not depend on the state of the session: version, kind, and that
/// each array frame has exactly the bytes that its header promises. Fault::version or Fault::protocol.
Message decode(transport::Frames frames);

/// The same for an envelope out of a mailbox: the fields of a step, all of whose arrays are shared.
Message decode_posted(transport::Frame const& envelope);

/// The kind of a message, from its first frame alone; KIND_NOT_SET if it cannot be read.
Kind peek_kind(transport::Frame const& envelope);

/// Is this how a client may begin? Heartbeats, last words of some earlier session, and questions are not.
inline bool may_open(Kind kind)
{
    return kind != Kind::kHeartbeat && kind != Kind::kError && kind != Kind::kGoodbye && kind != Kind::kStatusRequest &&
           kind != Kind::kStatus;
}

}  // namespace gimdem::coupling::message

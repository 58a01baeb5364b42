// SPDX-License-Identifier: BSD-3-Clause
/// What one side of a session does so that its fields travel through shared memory.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "message/Message.hpp"
#include "transport/Mailbox.hpp"
#include "transport/SendMemory.hpp"
#include "transport/SharedMemory.hpp"

namespace gimdem::coupling::session
{

/// Our segment and the peer's, each from its announcement to the end of the session. Whatever stands in the way leaves
/// a note and the fields go as plain frames; only an announcement that cannot be true is a fault.
class SharedFields
{
public:
    /// Does this side want it? Over tcp it never does.
    void want(bool wanted) { wanted_ = wanted; }

    /// Hello, Welcome.
    void offer(message::Message& greeting) const;
    /// Both sides must have offered it.
    void agree(message::Message const& greeting);

    /// Mesh, MeshAccepted: makes our segment; message_bytes of shared memory hold one message of ours.
    void announce(message::Message& message, std::size_t message_bytes);
    /// Mesh, MeshAccepted: maps the peer's segment. Fault::protocol if its notice cannot be true.
    /// Returns the peer's mailbox in it, if the peer posts.
    std::unique_ptr<transport::Postbox> map_announced(message::Message const& message);

    /// MeshAccepted, FluidState: says that we read the peer's segment.
    void confirm(message::Message& message) const;
    /// MeshAccepted, FluidState: if the peer reads our segment, `memory` packs into it from now on; otherwise it goes.
    /// Returns the outbox in it, if the peer looks into it.
    std::unique_ptr<transport::Outbox> use_if_confirmed(message::Message const& message,
                                                        transport::SendMemory const& memory);

    /// Points the shared arrays of a message at the peer's segment. Fault::protocol if one lies outside.
    void attach(message::Message& message) const;

    /// Why fields go as plain frames though both sides want shared memory; empty if they do not.
    std::string const& note() const { return note_; }

private:
    void note_obstacle(std::string const& obstacle);

    bool wanted_ = false;
    bool agreed_ = false;
    bool has_mailbox_ = false;  ///< both sides post
    std::string note_;
    std::shared_ptr<transport::OwnSegment> announced_;  ///< ours, until the peer has answered
    std::shared_ptr<transport::Mapping const> peer_;
};

}  // namespace gimdem::coupling::session

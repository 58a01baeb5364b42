// SPDX-License-Identifier: BSD-3-Clause
/// The last bytes of a shared segment: room for one envelope, and a bell. A message whose arrays lie in the segment
/// needs no socket, and so none of the four threads between the two programs has to wake up. docs/protocol.md, Mailbox.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "transport/Clock.hpp"
#include "transport/Frames.hpp"
#include "transport/SharedMemory.hpp"

namespace gimdem::coupling::transport
{

inline constexpr std::size_t mailbox_bytes = 4096;
/// The longest envelope that a mailbox holds; longer ones go through the socket [byte].
inline constexpr std::size_t max_posted_bytes = mailbox_bytes - 16;

/// What the bell stands on; the layout is part of the protocol.
struct MailboxPage;

/// Ours to write: the mailbox at the end of our segment.
class Outbox
{
public:
    explicit Outbox(std::shared_ptr<OwnSegment const> segment);

    /// Lays an envelope of max_posted_bytes at most into the box and rings. The one before must have been answered.
    void post(Frame const& envelope);

private:
    std::shared_ptr<OwnSegment const> segment_;
    MailboxPage* page_;
};

struct Post
{
    Frame envelope;
    Time posted;  ///< by the clock that all processes of a machine share
};

/// The peer's mailbox, which we read.
class Postbox
{
public:
    /// Fault::protocol if the segment is too small to have one.
    explicit Postbox(std::shared_ptr<Mapping const> segment);

    /// What was posted since the last call. Fault::protocol for an envelope that is too long, and for two at a time.
    std::optional<Post> take();
    /// Sleeps until the bell rings or it is that time; may return early.
    void wait(Time until) const;

private:
    std::shared_ptr<Mapping const> segment_;
    MailboxPage const* page_;
    std::uint32_t seen_ = 0;  ///< rings so far
    Time last_ = Clock::now();
};

}  // namespace gimdem::coupling::transport

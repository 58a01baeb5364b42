// SPDX-License-Identifier: BSD-3-Clause
/// The last bytes of a shared segment: room for one envelope, and a bell. A message whose arrays lie in the segment
/// needs no socket, and so none of the four threads between the two programs has to wake up. docs/protocol.md, Mailbox.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "transport/Clock.hpp"
#include "transport/Frames.hpp"
#include "transport/SharedMemory.hpp"

namespace gimdem::coupling::transport
{

inline constexpr std::size_t mailbox_bytes = 4096;
/// The longest envelope that a mailbox holds; longer ones go through the socket [byte].
inline constexpr std::size_t max_posted_bytes = mailbox_bytes - 28;

/// What lies there; the layout is part of the protocol.
struct MailboxPage;

/// Ours to write: the mailbox at the end of our segment. The message before must have been answered.
class Outbox
{
public:
    explicit Outbox(std::shared_ptr<OwnSegment const> segment);

    /// Wakes the peer up: a message is about to be announced.
    void knock();
    /// Rings for an envelope of max_posted_bytes at most whose arrays are packed next.
    void announce(Frame const& envelope);
    /// So many arrays of it are packed.
    void pack(std::size_t arrays);
    /// All arrays are packed: the message is sent.
    void finish();
    /// There will be no such message.
    void abandon();

private:
    void ring();
    void wake_reader();

    std::shared_ptr<OwnSegment const> segment_;
    MailboxPage* page_;
};

/// The peer's mailbox, which we read.
class Postbox
{
public:
    enum class Packing
    {
        going_on,
        complete,
        abandoned
    };

    /// Fault::protocol if the segment is too small to have one.
    explicit Postbox(std::shared_ptr<Mapping const> segment);

    /// The envelope of the message that the peer packs or has packed, once. Fault::protocol for one that is too long.
    std::optional<Frame> look();
    /// How it stands with that message. Waits a little for the end of packing, without sleeping, and calls
    /// meanwhile(n) when n of its arrays are packed.
    Packing packing(std::function<void(std::size_t)> const& meanwhile = {});
    /// When that message was complete, by the clock that all processes of a machine share.
    Time posted();
    /// The segment that the arrays lie in.
    Mapping const& memory() const { return *segment_; }
    /// Sleeps until the bell rings again or it is that time; may return early. Whom a knock has woken stays awake a
    /// little for the ring.
    void wait(Time until) const;

private:
    std::uint32_t bell();
    bool is_in_the_way() const;

    std::shared_ptr<Mapping const> segment_;
    MailboxPage const* page_;
    std::uint32_t seen_ = 0;       ///< rings so far
    std::uint32_t announced_ = 0;  ///< the ring that announced the message that look() gave out
    Time last_ = Clock::now();
};

}  // namespace gimdem::coupling::transport

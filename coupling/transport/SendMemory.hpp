// SPDX-License-Identifier: BSD-3-Clause
/// Where the arrays of the next message are packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "transport/FramePool.hpp"
#include "transport/SharedMemory.hpp"

namespace gimdem::coupling::transport
{

/// Arrays below this travel in frames: a frame of this size costs less than what it saves [byte].
inline constexpr std::size_t least_shared_bytes = 1 << 10;
/// Messages that lie in a segment at a time, docs/protocol.md, Shared memory.
inline constexpr std::size_t slot_count = 3;
/// Arrays begin at multiples of this, a cache line [byte].
inline constexpr std::size_t shared_alignment = 64;

/// The next multiple of the alignment.
std::size_t aligned_bytes(std::size_t bytes);
/// Bytes of a slot that such an array takes; none if it goes as a frame.
std::size_t shared_bytes(std::size_t array_bytes);
/// Size of a segment whose slots hold so many bytes each: the slots, then the mailbox.
std::size_t segment_bytes(std::size_t slot_bytes);

/// A ring of slots in our shared segment once the peer reads it; before that, and for what does not fit, pooled frames.
/// One message is packed at a time, by one thread. Copies share the memory.
class SendMemory
{
public:
    SendMemory();

    /// From now on use this segment.
    void use(std::shared_ptr<OwnSegment> segment) const;

    /// A new message is packed into the slot that is next; what was packed there but not sent is forgotten.
    void begin_message() const;
    /// A frame of so many bytes, not initialised.
    /// any_size: small ones go to the segment, too, so that a message with large and small arrays can be posted.
    Frame make(std::size_t bytes, bool any_size = false) const;
    /// Where in the segment that frame lies; empty if it is an ordinary one [byte].
    std::optional<std::uint64_t> offset_of(Frame const& frame) const;
    /// The message is on its way: its slot belongs to the reader until slot_count - 1 more have been sent.
    void message_sent() const;

private:
    struct Ring;
    std::shared_ptr<Ring> ring_;
    FramePool pool_;
};

}  // namespace gimdem::coupling::transport

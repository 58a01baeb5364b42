// SPDX-License-Identifier: BSD-3-Clause
#include "transport/SendMemory.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "transport/Mailbox.hpp"

namespace gimdem::coupling::transport
{

struct SendMemory::Ring
{
    std::shared_ptr<OwnSegment> segment;
    std::size_t slot = 0;  ///< of the message that is packed now
    std::size_t used = 0;  ///< of that slot [byte]

    /// A multiple of the alignment [byte].
    std::size_t slot_bytes() const
    {
        return (segment->memory().bytes() - mailbox_bytes) / slot_count / shared_alignment * shared_alignment;
    }

    /// The next free place in the slot, or null.
    unsigned char* place(std::size_t bytes, bool any_size)
    {
        if (!segment || segment->memory().bytes() < mailbox_bytes || (bytes < least_shared_bytes && !any_size) ||
            bytes > slot_bytes() - used)
            return nullptr;
        unsigned char* const begin = segment->memory().data() + slot * slot_bytes() + used;
        used = std::min(slot_bytes(), used + aligned_bytes(bytes));
        return begin;
    }
};

std::size_t aligned_bytes(std::size_t bytes)
{
    return (bytes + shared_alignment - 1) / shared_alignment * shared_alignment;
}

std::size_t shared_bytes(std::size_t array_bytes)
{
    return array_bytes < least_shared_bytes ? 0 : aligned_bytes(array_bytes);
}

std::size_t segment_bytes(std::size_t slot_bytes)
{
    return slot_count * slot_bytes + mailbox_bytes;
}

SendMemory::SendMemory() : ring_(std::make_shared<Ring>()) {}

void SendMemory::use(std::shared_ptr<OwnSegment> segment) const
{
    ring_->segment = std::move(segment);
}

void SendMemory::begin_message() const
{
    ring_->used = 0;
}

Frame SendMemory::make(std::size_t bytes, bool any_size) const
{
    if (unsigned char* const place = ring_->place(bytes, any_size))
        return Frame(
            place, bytes, [](void*, void*) {}, nullptr);
    return pool_.make(bytes);
}

std::optional<std::uint64_t> SendMemory::offset_of(Frame const& frame) const
{
    if (!ring_->segment) return std::nullopt;
    Mapping const& memory = ring_->segment->memory();
    auto const* const begin = static_cast<unsigned char const*>(frame.data());
    std::less<> const before;
    if (before(begin, memory.data()) || !before(begin, memory.data() + memory.bytes())) return std::nullopt;
    return static_cast<std::uint64_t>(begin - memory.data());
}

void SendMemory::message_sent() const
{
    ring_->slot = (ring_->slot + 1) % slot_count;
}

}  // namespace gimdem::coupling::transport

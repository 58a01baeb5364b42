// SPDX-License-Identifier: BSD-3-Clause
#include "message/SharedArrays.hpp"

#include <algorithm>

#include "message/Arrays.hpp"

namespace gimdem::coupling::message
{
namespace
{

std::size_t byte_count(v1::ArrayHeader const& header)
{
    return header.count() * header.components() * element_size(header.type());
}

void attach(v1::ArrayHeader const& header, transport::Frame& frame, transport::Mapping const& memory)
{
    std::size_t const bytes = byte_count(header);
    auto const who = [&]
    {
        return "array \"" + header.name() + "\" of " + std::to_string(bytes) + " bytes at offset " +
               std::to_string(header.offset()) + " of the shared memory";
    };
    if (header.offset() > memory.bytes() || bytes > memory.bytes() - header.offset())
        refuse(who() + " lies out of bounds (the segment has " + std::to_string(memory.bytes()) + " bytes)");
    if (header.offset() % element_size(header.type()) != 0) refuse(who() + " is not aligned to its numbers");
    frame = transport::Frame(
        memory.data() + header.offset(), bytes, [](void*, void*) {}, nullptr);
}

}  // namespace

void mark_shared(Message& message, std::uint64_t offset)
{
    v1::ArrayHeader& header = *message.envelope.mutable_arrays()->rbegin();
    header.set_shared(true);
    header.set_offset(offset);
}

void attach_shared(Message& message, transport::Mapping const* memory)
{
    for (std::size_t k = 0; k < message.arrays.size(); ++k)
    {
        v1::ArrayHeader const& header = message.envelope.arrays(static_cast<int>(k));
        if (!header.shared()) continue;
        if (!memory) refuse("array \"" + header.name() + "\" lies in shared memory, but none of the sender is mapped");
        attach(header, message.arrays[k], *memory);
    }
}

std::size_t array_bytes(Message const& message)
{
    std::size_t sum = 0;
    for (std::size_t k = 0; k < message.arrays.size(); ++k)
    {
        v1::ArrayHeader const& header = message.envelope.arrays(static_cast<int>(k));
        bool const packed = header.compression() != v1::COMPRESSION_NONE;
        sum += packed ? message.arrays[k].size() : byte_count(header);
    }
    return sum;
}

void offer_shared_memory(Message& message)
{
    message.envelope.mutable_shared_memory()->set_offered(true);
    message.envelope.mutable_shared_memory()->set_mailbox(true);
}

bool offers_shared_memory(Message const& message)
{
    return message.envelope.shared_memory().offered();
}

bool offers_mailbox(Message const& message)
{
    return message.envelope.shared_memory().mailbox();
}

bool may_be_posted(Message const& message)
{
    auto const& headers = message.envelope.arrays();
    return (message.kind() == Kind::kFluidState || message.kind() == Kind::kSolidState) &&
           std::all_of(headers.begin(), headers.end(), [](v1::ArrayHeader const& header) { return header.shared(); });
}

void announce_segment(Message& message, transport::SegmentNotice const& notice)
{
    message.envelope.mutable_shared_memory()->set_name(notice.name);
    message.envelope.mutable_shared_memory()->set_bytes(notice.bytes);
}

transport::SegmentNotice announced_segment(Message const& message)
{
    return {message.envelope.shared_memory().name(), message.envelope.shared_memory().bytes()};
}

void confirm_segment(Message& message)
{
    message.envelope.mutable_shared_memory()->set_mapped(true);
}

bool confirms_segment(Message const& message)
{
    return message.envelope.shared_memory().mapped();
}

}  // namespace gimdem::coupling::message

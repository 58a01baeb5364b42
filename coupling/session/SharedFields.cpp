// SPDX-License-Identifier: BSD-3-Clause
#include "session/SharedFields.hpp"

#include <utility>

#include "message/SharedArrays.hpp"

namespace gimdem::coupling::session
{

void SharedFields::offer(message::Message& greeting) const
{
    if (wanted_) message::offer_shared_memory(greeting);
}

void SharedFields::agree(message::Message const& greeting)
{
    agreed_ = wanted_ && message::offers_shared_memory(greeting);
    has_mailbox_ = agreed_ && message::offers_mailbox(greeting);
}

void SharedFields::announce(message::Message& message, std::size_t message_bytes)
{
    if (!agreed_ || message_bytes == 0) return;
    auto made = transport::make_segment(transport::segment_bytes(message_bytes));
    note_obstacle(made.obstacle);
    announced_ = std::move(made.segment);
    if (announced_) message::announce_segment(message, announced_->notice());
}

std::unique_ptr<transport::Postbox> SharedFields::map_announced(message::Message const& message)
{
    transport::SegmentNotice const notice = message::announced_segment(message);
    if (!agreed_ || notice.empty()) return nullptr;
    auto mapped = transport::map_segment(notice);
    note_obstacle(mapped.obstacle);
    peer_ = std::move(mapped.segment);
    return peer_ && has_mailbox_ ? std::make_unique<transport::Postbox>(peer_) : nullptr;
}

void SharedFields::confirm(message::Message& message) const
{
    if (peer_) message::confirm_segment(message);
}

std::unique_ptr<transport::Outbox> SharedFields::use_if_confirmed(message::Message const& message,
                                                                  transport::SendMemory const& memory)
{
    if (!announced_) return nullptr;
    auto const segment = std::move(announced_);
    segment->remove_name();
    if (!message::confirms_segment(message)) return nullptr;
    memory.use(segment);
    return has_mailbox_ ? std::make_unique<transport::Outbox>(segment) : nullptr;
}

void SharedFields::attach(message::Message& message) const
{
    message::attach_shared(message, peer_.get());
}

void SharedFields::note_obstacle(std::string const& obstacle)
{
    if (obstacle.empty() || !note_.empty()) return;
    note_ = obstacle + "; fields travel as plain frames, which is slower and otherwise the same";
}

}  // namespace gimdem::coupling::session

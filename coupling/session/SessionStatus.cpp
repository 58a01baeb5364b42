// SPDX-License-Identifier: BSD-3-Clause
/// How a session answers a StatusRequest: on the I/O thread of its channel, whatever the program is doing.
#include "session/Session.hpp"

#include <utility>

#include "message/Codec.hpp"
#include "message/StatusMessages.hpp"

namespace gimdem::coupling::session
{

using message::Kind;
using transport::Clock;

std::optional<transport::Frames> Session::on_question(transport::Frames& frames)
{
    bool const is_short = frames.size() == 1 && frames.front().size() <= message::max_question_bytes;
    if (!is_short || message::peek_kind(frames.front()) != Kind::kStatusRequest) return std::nullopt;
    if (!desk_.may_answer(Clock::now())) return transport::Frames{};
    try
    {
        message::decode(std::move(frames));  // for its version
        return message::encode(message::pack(status()));
    }
    catch (CouplingError const& error)
    {
        message::ErrorReport report;
        report.fault = error.fault();
        report.reason = error.what();
        report.state = name_of(state());
        report.name = name_;
        return message::encode(message::pack(report));
    }
}

Status Session::status() const
{
    Status status = desk_.fill();
    Time const now = Clock::now();
    std::lock_guard<std::mutex> const lock(mutex_);
    status.server = name_;
    status.state = name_of(state_);
    status.state_time = transport::seconds_between(state_since_, now);
    status.step = step_;
    status.client = peer_.empty() ? peer_heartbeat_.name : peer_;
    status.client_state = peer_heartbeat_.state;
    if (heard_) status.client_silence = transport::seconds_between(*heard_, now);
    return status;
}

}  // namespace gimdem::coupling::session

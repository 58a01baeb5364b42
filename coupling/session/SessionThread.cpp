// SPDX-License-Identifier: BSD-3-Clause
/// What a session does on the I/O thread of its channel.
#include "session/Session.hpp"

#include <utility>

#include "message/Codec.hpp"

namespace gimdem::coupling::session
{

using message::Kind;
using message::Message;

std::optional<double> Session::on_frames(transport::Frames frames, Time arrival)
{
    note_heard(arrival);
    try
    {
        std::size_t const bytes = transport::byte_count(frames);
        std::size_t const most = most_array_bytes_ + (frames.empty() ? 0 : frames.front().size());
        if (bytes > most)
            message::refuse("a message of " + std::to_string(bytes) +
                            " bytes (no message of this session has more than " + std::to_string(most) + ")");
        return on_message(message::decode(std::move(frames)), arrival);
    }
    catch (CouplingError const& error)
    {
        inbox_.put({{}, error, arrival});
        return std::nullopt;
    }
}

std::optional<double> Session::on_message(Message message, Time arrival)
{
    if (message.kind() == Kind::kHeartbeat)
    {
        message::Heartbeat const heartbeat = message::unpack_heartbeat(message);
        std::lock_guard<std::mutex> const lock(mutex_);
        peer_heartbeat_ = heartbeat;
        inbox_.note_contact();
        return heartbeat.timeout;
    }
    std::optional<double> peer_timeout;
    if (message.kind() == Kind::kHello && message.envelope.hello().timeout() >= message::min_timeout)
        peer_timeout = message.envelope.hello().timeout();
    inbox_.put({std::move(message), std::nullopt, arrival});
    return peer_timeout;
}

transport::Frames Session::on_heartbeat_due() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    Message message = message::pack(message::Heartbeat{name_, name_of(state_), step_, progress_, timeout_});
    return message::encode(std::move(message));
}

void Session::on_note(std::string const& text)
{
    if (log_) log_(text);
    std::lock_guard<std::mutex> const lock(mutex_);
    connection_note_ = text;
}

transport::Frames Session::on_stranger(transport::Frames frames) const
{
    message::ErrorReport report;
    report.fault = Fault::peer;
    report.reason = "the server is busy with " + peer_name() + "; start a server of your own at another endpoint";
    report.state = name_of(state());
    report.name = name_;
    try
    {
        if (!message::may_open(message::decode(std::move(frames)).kind())) return {};
    }
    catch (CouplingError const& error)
    {
        report.fault = error.fault();
        report.reason = error.what();
    }
    return message::encode(message::pack(report));
}

}  // namespace gimdem::coupling::session

// SPDX-License-Identifier: BSD-3-Clause
#include "session/ServerSession.hpp"

#include <utility>

#include "message/ClockMessages.hpp"
#include "session/Options.hpp"

namespace gimdem::coupling::session
{

using transport::Clock;
using transport::ticks;

ServerSession::ServerSession(ServerOptions given, std::optional<Rank> expected)
    : options_(std::move(given)),
      expected_rank_(expected),
      session_(transport::Role::server, options_.name, options_.timeout)
{
    require_name(options_.name, "ServerOptions.name");
    require_seconds(options_.timeout, message::min_timeout, "ServerOptions.timeout");
    require_seconds(options_.connect_time, 0, "ServerOptions.connect_time");
    require_seconds(options_.step_time, message::min_timeout, "ServerOptions.step_time");
    std::optional<transport::ServerKeys> keys;
    if (!options_.keys.empty()) keys = transport::read_server_keys(options_.keys);
    session_.open(transport::Socket::bind(options_.endpoint, keys), options_.log);
    shared_.want(options_.shared_memory && session_.is_ipc());
    if (options_.clock_origin == 0) options_.clock_origin = clock_now();
}

void ServerSession::request_stop(std::string const& reason)
{
    std::lock_guard<std::mutex> const lock(stop_mutex_);
    stop_ = reason;
}

std::optional<std::string> ServerSession::stop_reason()
{
    std::lock_guard<std::mutex> const lock(stop_mutex_);
    return stop_;
}

Letter ServerSession::receive(std::string const& awaited)
{
    return session_.receive(awaited, Clock::now() + ticks(options_.step_time), options_.step_time);
}

bool ServerSession::said_goodbye(Letter const& letter)
{
    if (letter.message.kind() != message::Kind::kGoodbye) return false;
    goodbye_ = message::unpack_goodbye(letter.message);
    last_client_step_ = session_.read([&] { return message::unpack_last_step(letter.message); });
    return true;
}

void ServerSession::save_checkpoint(Letter const& letter)
{
    CheckpointRequest const request = session_.read([&] { return message::unpack_checkpoint_request(letter.message); });
    if (!saves_checkpoints())
        session_.fail(Fault::protocol, message::describe(letter.message) + " from " + session_.peer_name() +
                                           " is not allowed (this server saves none, as its Welcome told); do not ask "
                                           "for one");
    message::Message answer = message::pack(saver_(request));
    session_.advance(Event::checkpoint_is_saved);
    session_.send(std::move(answer));
}

}  // namespace gimdem::coupling::session

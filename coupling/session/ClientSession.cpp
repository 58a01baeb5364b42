// SPDX-License-Identifier: BSD-3-Clause
#include "session/ClientSession.hpp"

#include <utility>

#include "session/Options.hpp"

namespace gimdem::coupling::session
{

using transport::Clock;
using transport::ticks;

ClientSession::ClientSession(ClientOptions given)
    : options_(std::move(given)),
      session_(transport::Role::client, name_of_rank(options_.name, options_.rank), options_.timeout)
{
    require_name(options_.name, "ClientOptions.name");
    require_rank(options_.rank);
    require_seconds(options_.timeout, message::min_timeout, "ClientOptions.timeout");
    require_seconds(options_.connect_time, 0, "ClientOptions.connect_time");
    require_seconds(options_.step_time, message::min_timeout, "ClientOptions.step_time");
    if (!options_.keys.empty()) keys_ = transport::read_client_keys(options_.keys);
    if (options_.wants.empty()) options_.wants = {field::void_fraction, field::drag_coefficient, field::drag_momentum};
    terms_.solid = message::choose_solid_fields(options_.wants, Fault::user);
}

SavedCheckpoint ClientSession::save_checkpoint(CheckpointRequest const& request)
{
    session_.require(Event::save_checkpoint);
    if (!welcome_.saves_checkpoints)
        throw CouplingError(Fault::user, session_.peer_name() +
                                             " saves no checkpoints when asked (Welcome::saves_checkpoints tells); "
                                             "do not ask for one");
    message::Message message = message::pack(request);
    session_.look_for_trouble("the fluid of its program");
    session_.advance(Event::save_checkpoint);
    session_.send(std::move(message));
    Letter const letter = receive("CheckpointSaved");
    return session_.read([&] { return message::unpack_saved_checkpoint(letter.message); });
}

void ClientSession::finish(std::string const& reason)
{
    session_.require(Event::finish);
    bool const greeted = session_.state() != State::created && session_.state() != State::finished;
    message::Message goodbye = message::pack_goodbye(reason);
    record_.put_into_goodbye(goodbye, previous_);
    if (greeted) session_.send(std::move(goodbye));
    record_.log().write(LogLevel::info, "finished", reason,
                        {{"steps", static_cast<double>(step_.number)},
                         {"exchange_s", clock_.times().exchange},
                         {"waiting_s", clock_.times().waiting},
                         {"bytes", clock_.times().bytes}});
    session_.advance(Event::finish);
    session_.close();
}

void ClientSession::abort(std::string const& reason) noexcept
{
    try
    {
        record_.log().write(LogLevel::error, "aborted", reason);
    }
    catch (std::exception const&)
    {
        // The log is of no use to a program that is out of memory.
    }
    session_.abort(Fault::user, reason);
}

void ClientSession::note_fault(std::string const& text)
{
    session_.note(text);
    record_.log().write(LogLevel::error, "fault", text);
}

Letter ClientSession::receive(std::string const& awaited)
{
    return session_.receive(awaited, Clock::now() + ticks(options_.step_time), options_.step_time);
}

}  // namespace gimdem::coupling::session

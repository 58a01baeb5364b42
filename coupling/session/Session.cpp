// SPDX-License-Identifier: BSD-3-Clause
#include "session/Session.hpp"

#include <chrono>
#include <cstdio>
#include <random>
#include <utility>

#include "message/Codec.hpp"

namespace gimdem::coupling::session
{
namespace
{

using namespace std::chrono_literals;
using message::Kind;
using message::Message;

/// Last words get so long to leave.
auto constexpr linger = 1s;

std::string named(Role role, std::string const& name)
{
    std::string const who = role == Role::client ? "client" : "server";
    return name.empty() ? "the " + who : who + " \"" + name + "\"";
}

Role other(Role role)
{
    return role == Role::client ? Role::server : Role::client;
}

}  // namespace

std::string seconds_text(double seconds)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g s", seconds);
    return text;
}

Session::Session(Role role, std::string name, double timeout)
    : role_(role),
      name_(std::move(name)),
      timeout_(timeout),
      rules_(role == Role::client ? client_rules() : server_rules()),
      state_(role == Role::client ? State::created : State::listening)
{
}

Session::~Session()
{
    std::string const why = last_fault_.empty() ? "its program ended without saying why" : last_fault_;
    abort(Fault::user, why);
}

void Session::open(transport::Socket socket)
{
    transport::ChannelHooks hooks;
    hooks.deliver = [this](transport::Frames frames, Time arrival) { return on_frames(std::move(frames), arrival); };
    hooks.heartbeat = [this] { return on_heartbeat_due(); };
    hooks.may_open = [this](transport::Frame const& first)
    { return role_ == Role::client || message::may_open(message::peek_kind(first)); };
    hooks.answer_stranger = [this](transport::Frames frames) { return on_stranger(std::move(frames)); };
    hooks.ended = [this](transport::Ending ending) { inbox_.end(std::move(ending)); };
    endpoint_ = socket.endpoint();
    channel_ = std::make_unique<transport::Channel>(std::move(socket), timeout_, std::move(hooks));
}

State Session::state() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return state_;
}

bool Session::is_over() const
{
    State const now = state();
    return now == State::finished || now == State::failed;
}

void Session::require(Event call)
{
    if (next_state(rules_, state(), call)) return;
    std::string const why = state() == State::failed ? " after the fault: " + last_fault_ : "";
    throw CouplingError(Fault::user, name_of(call) + " is illegal " + here() + why +
                                         "; keep to the order of calls that the header of " + our_name() + " shows");
}

void Session::advance(Event event)
{
    std::lock_guard<std::mutex> const lock(mutex_);
    state_ = next_state(rules_, state_, event).value_or(State::failed);
    ++progress_;
}

void Session::set_step(std::int64_t step)
{
    std::lock_guard<std::mutex> const lock(mutex_);
    step_ = step;
}

void Session::choose_session_number()
{
    std::random_device random;
    do
        session_number_ = (std::uint64_t{random()} << 32) | random();
    while (session_number_ == 0);
}

void Session::send(Message message)
{
    message.envelope.set_session(session_number_);
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        message.envelope.set_step(step_);
    }
    transport::Frames frames = message::encode(std::move(message));
    bytes_ += static_cast<double>(transport::byte_count(frames));
    channel_->send(std::move(frames));
}

Letter Session::receive(std::string const& awaited, Time deadline, double patience)
{
    Delivery delivery = inbox_.wait(deadline);
    if (delivery.ending) fail_by_ending(*delivery.ending, awaited);
    if (!delivery.letter) fail_by_delay(awaited, patience);

    check_letter(*delivery.letter, awaited);
    Message const& message = delivery.letter->message;
    bytes_ += static_cast<double>(message.envelope.ByteSizeLong() + transport::byte_count(message.arrays));
    advance(*event_of(message.kind()));
    return std::move(*delivery.letter);
}

void Session::look_for_trouble(std::string const& awaited)
{
    auto const kind = inbox_.peek();
    auto const event = kind ? event_of(*kind) : std::nullopt;
    bool const expected = event && next_state(rules_, state(), *event);
    if (expected) return;
    if (kind || inbox_.has_ended()) receive(awaited, Time::min(), 0);
}

void Session::check_letter(Letter const& letter, std::string const& awaited)
{
    if (letter.refusal)
        fail(letter.refusal->fault(), peer_name() + " sent something unusable: " + letter.refusal->what() + " (" +
                                          here() + ", waiting for " + awaited + ")");
    if (letter.message.kind() == Kind::kError) fail_by_peer(letter.message, awaited);
    check_session_number(letter.message, awaited);

    auto const event = event_of(letter.message.kind());
    if (!event || !next_state(rules_, state(), *event))
        fail(Fault::protocol, message::describe(letter.message) + " from " + peer_name() + " is out of order " +
                                  here() + " (allowed here: " + allowed_messages(rules_, state()) +
                                  "); the two programs do not fit together, see docs/protocol.md");
}

void Session::check_session_number(Message const& message, std::string const& awaited)
{
    bool const opens = message.kind() == Kind::kHello || message.kind() == Kind::kWelcome;
    std::uint64_t const number = message.envelope.session();
    if (role_ == Role::client && message.kind() == Kind::kWelcome && state() == State::greeting)
        session_number_ = number;
    if (opens || number == session_number_) return;
    fail(Fault::protocol, message::describe(message) + " from " + peer_name() + " belongs to session " +
                              std::to_string(number) + " instead of " + std::to_string(session_number_) + " (" +
                              here() + ", waiting for " + awaited + "); is an old program still running?");
}

void Session::fail(Fault fault, std::string const& text)
{
    tell(fault, text);
    fall(text);
    throw CouplingError(fault, text);
}

void Session::fail_by_peer(Message const& message, std::string const& awaited)
{
    message::ErrorReport const report = message::unpack_error(message);
    bool const special = report.fault == Fault::mesh || report.fault == Fault::version;
    set_peer_name(report.name);
    std::string const text = peer_name() + (report.fault == Fault::mesh ? " refused the mesh: " : " ended the run: ") +
                             report.reason + " (it was in state " + report.state + ", step " +
                             std::to_string(report.step) + "); " + our_name() + " was waiting for " + awaited + " " +
                             here();
    fall(text);
    throw CouplingError(special ? report.fault : Fault::peer, text);
}

void Session::fail_by_ending(transport::Ending const& ending, std::string const& awaited)
{
    std::string const us = our_name() + " was waiting for " + awaited + " " + here();
    if (ending.kind == transport::Ending::Kind::silent)
        fail(Fault::timeout, peer_name() + " at " + endpoint_ + " has been silent for " + seconds_text(ending.silence) +
                                 " (time-out " + seconds_text(timeout_) + "; " + last_word() + "); " + us +
                                 "; see whether it was stopped or hangs, or raise the time-out");
    std::string const detail = ending.detail.empty() ? "" : ", " + ending.detail;
    fail(Fault::peer, peer_name() + " at " + endpoint_ + " has disappeared (its connection broke" + detail + "; " +
                          last_word() + "); " + us + "; its own output should tell why it ended");
}

void Session::fail_by_delay(std::string const& awaited, double patience)
{
    fail(Fault::timeout, peer_name() + " at " + endpoint_ + " has not sent " + awaited + " within " +
                             seconds_text(patience) + " (" + last_word() + "); " + our_name() + " was waiting " +
                             here() + "; see what it is doing, or allow more time");
}

void Session::fall(std::string const& why)
{
    last_fault_ = why;
    std::lock_guard<std::mutex> const lock(mutex_);
    state_ = State::failed;
    ++progress_;
}

void Session::tell(Fault fault, std::string const& reason)
{
    if (!channel_ || !inbox_.has_contact()) return;
    message::ErrorReport report;
    report.fault = fault;
    report.reason = reason;
    report.state = name_of(state());
    report.name = name_;
    send(message::pack(report));
}

void Session::abort(Fault fault, std::string const& reason) noexcept
{
    try
    {
        if (!is_over())
        {
            tell(fault, reason);
            fall(reason);
        }
    }
    catch (std::exception const&)
    {
        // The peer will see the connection break.
    }
    close();
}

void Session::close() noexcept
{
    if (!channel_) return;
    channel_->close(linger);
    channel_.reset();
}

std::string Session::our_name() const
{
    return named(role_, name_);
}

std::string Session::peer_name() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return named(other(role_), peer_.empty() ? peer_heartbeat_.name : peer_);
}

void Session::set_peer_name(std::string const& name)
{
    std::lock_guard<std::mutex> const lock(mutex_);
    if (!name.empty()) peer_ = name;
}

/// "in state waiting, step 17".
std::string Session::here() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return "in state " + name_of(state_) + ", step " + std::to_string(step_);
}

std::string Session::last_word() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    if (peer_heartbeat_.state.empty()) return "it has said nothing of its state";
    return "its last heartbeat told state " + peer_heartbeat_.state + ", step " + std::to_string(peer_heartbeat_.step) +
           ", progress " + std::to_string(peer_heartbeat_.progress);
}

std::optional<double> Session::on_frames(transport::Frames frames, Time arrival)
{
    try
    {
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

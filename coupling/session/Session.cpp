// SPDX-License-Identifier: BSD-3-Clause
#include "session/Session.hpp"

#include <algorithm>
#include <chrono>
#include <random>
#include <utility>

#include "message/Codec.hpp"
#include "message/Fields.hpp"
#include "message/SharedArrays.hpp"

namespace gimdem::coupling::session
{
namespace
{

using namespace std::chrono_literals;
using message::Kind;
using message::Message;

/// Last words get so long to leave.
auto constexpr linger = 1s;
/// Whoever waits for the bell of a mailbox looks this often whether something came through the channel.
auto constexpr look_interval = 20ms;

}  // namespace

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

void Session::open(transport::Socket socket, std::function<void(std::string const&)> log)
{
    log_ = std::move(log);
    transport::ChannelHooks hooks;
    hooks.deliver = [this](transport::Frames frames, Time arrival) { return on_frames(std::move(frames), arrival); };
    hooks.heartbeat = [this] { return on_heartbeat_due(); };
    hooks.may_open = [this](transport::Frame const& first)
    { return role_ == Role::client || message::may_open(message::peek_kind(first)); };
    hooks.answer_stranger = [this](transport::Frames frames) { return on_stranger(std::move(frames)); };
    hooks.note = [this](std::string const& text) { on_note(text); };
    if (role_ == Role::server)
        hooks.answer_question = [this](transport::Frames& frames) { return on_question(frames); };
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
    state_since_ = transport::Clock::now();
    ++progress_;
}

void Session::note_heard(Time arrival)
{
    std::lock_guard<std::mutex> const lock(mutex_);
    heard_ = std::max(heard_.value_or(arrival), arrival);
}

void Session::set_step(std::int64_t step)
{
    std::lock_guard<std::mutex> const lock(mutex_);
    step_ = step;
}

void Session::limit_arrays(std::size_t bytes)
{
    most_array_bytes_ = std::max(bytes, least_limit);
}

void Session::choose_session_number()
{
    std::random_device random;
    do
        session_number_ = (std::uint64_t{random()} << 32) | random();
    while (session_number_ == 0);
}

void Session::announce_soon()
{
    if (outbox_) outbox_->knock();
}

void Session::prepare(Message& message)
{
    stamp(message);
    is_announced_ = false;
    if (!outbox_ || !message::may_be_posted(message)) return message::fill(message);
    transport::Frame const envelope = message::encode_envelope(message);
    if (envelope.size() > transport::max_posted_bytes) return message::fill(message);

    outbox_->announce(envelope);
    try
    {
        message::fill(message, [&](std::size_t arrays) { outbox_->pack(arrays); });
    }
    catch (CouplingError const&)
    {
        outbox_->abandon();
        throw;
    }
    is_announced_ = true;
}

void Session::send(Message message)
{
    stamp(message);
    bytes_ += static_cast<double>(message::array_bytes(message));
    if (std::exchange(is_announced_, false) && message::may_be_posted(message))
    {
        bytes_ += static_cast<double>(message.envelope.ByteSizeLong());
        return outbox_->finish();
    }
    transport::Frames frames = message::encode(std::move(message));
    bytes_ += static_cast<double>(frames.front().size());
    channel_->send(std::move(frames));
}

/// Session and step, unless the message knows its step.
void Session::stamp(Message& message) const
{
    message.envelope.set_session(session_number_);
    if (message.envelope.step() != 0) return;
    std::lock_guard<std::mutex> const lock(mutex_);
    message.envelope.set_step(step_);
}

Letter Session::receive(std::string const& awaited, Time deadline, double patience)
{
    Delivery delivery = next_letter(deadline);
    if (delivery.ending) fail_by_ending(*delivery.ending, awaited);
    if (!delivery.letter) fail_by_delay(awaited, patience);

    check_letter(*delivery.letter, awaited);
    Message const& message = delivery.letter->message;
    bytes_ += static_cast<double>(message.envelope.ByteSizeLong() + message::array_bytes(message));
    advance(*event_of(message.kind()));
    note_heard(delivery.letter->arrival);
    return std::move(*delivery.letter);
}

bool Session::wait_for_contact(Time deadline)
{
    if (!watch_) return inbox_.wait_for_contact(deadline);
    while (true)
    {
        Time const now = transport::Clock::now();
        if (inbox_.wait_for_contact(std::min(deadline, now + look_interval))) return true;
        if (now >= deadline) return false;
        watch_();
    }
}

Delivery Session::watched_letter(Time deadline)
{
    while (true)
    {
        Time const now = transport::Clock::now();
        Delivery delivery = inbox_.wait(std::min(deadline, now + look_interval));
        if (delivery.letter || delivery.ending || now >= deadline) return delivery;
        watch_();
    }
}

Delivery Session::next_letter(Time deadline)
{
    if (!postbox_) return watch_ ? watched_letter(deadline) : inbox_.wait(deadline);
    while (true)
    {
        if (auto letter = take_post()) return {std::move(letter), std::nullopt};
        Time const now = transport::Clock::now();
        if (now >= deadline || inbox_.peek() || inbox_.has_ended()) return inbox_.wait(now);
        postbox_->wait(std::min(deadline, now + look_interval));
        if (watch_) watch_();
    }
}

std::optional<Letter> Session::take_post()
{
    try
    {
        if (auto const envelope = postbox_->look())
        {
            incoming_ = message::decode_posted(*envelope);
            message::attach_shared(*incoming_, &postbox_->memory());
        }
        if (!incoming_) return std::nullopt;
        auto const packing = postbox_->packing([&](std::size_t packed) { take_in_(*incoming_, packed); });
        if (packing == transport::Postbox::Packing::going_on) return std::nullopt;
        Message message = std::move(*incoming_);
        incoming_.reset();
        if (packing == transport::Postbox::Packing::abandoned) return std::nullopt;
        return Letter{std::move(message), std::nullopt, postbox_->posted()};
    }
    catch (CouplingError const& error)
    {
        return Letter{{}, error, transport::Clock::now()};
    }
}

void Session::look_for_trouble(std::string const& awaited)
{
    auto const kind = inbox_.peek();
    auto const event = kind ? event_of(*kind) : std::nullopt;
    bool const expected = event && next_state(rules_, state(), *event);
    if (expected) return;
    if (kind || inbox_.has_ended()) receive(awaited, Time::min(), 0);
}

void Session::look_for_loss(std::string const& awaited)
{
    if (is_over()) return;
    look_for_trouble(awaited);
    if (inbox_.peek() == Kind::kGoodbye) return;
    if (auto const ending = inbox_.ending()) fail_by_ending(*ending, awaited);
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

void Session::close() noexcept
{
    if (!channel_) return;
    channel_->close(linger);
    channel_.reset();
}

}  // namespace gimdem::coupling::session

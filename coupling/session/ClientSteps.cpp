// SPDX-License-Identifier: BSD-3-Clause
/// Fluid and solid of each step.
#include <utility>

#include "session/ClientSession.hpp"

namespace gimdem::coupling::session
{

using transport::Clock;

void ClientSession::begin_step(Step const& next, FluidFields const& fields, std::vector<Monitor> const& monitors)
{
    ExchangeTimes const& so_far = clock_.times();
    send_fluid(begin_event(),
               {next, fields, monitors, previous_, so_far.exchange, so_far.waiting, 0, previous_residual_},
               Clock::now());
}

void ClientSession::iterate_step(FluidFields const& estimate, double residual)
{
    ExchangeTimes const& so_far = clock_.times();
    send_fluid(Event::iterate_step,
               {step_, estimate, {}, previous_, so_far.exchange, so_far.waiting, pass_ + 1, residual}, Clock::now());
}

Event ClientSession::begin_event() const
{
    switch (welcome_.schedule)
    {
        case Schedule::overlapped:
            return Event::begin_overlapped_step;
        case Schedule::iterated:
            return Event::begin_iterated_step;
        default:
            return Event::begin_serial_step;
    }
}

/// Sends a fluid and, unless both compute at once, takes its answer.
void ClientSession::send_fluid(Event call, FluidState const& given, Time entered)
{
    session_.require(call);
    session_.announce_soon();
    if (call == Event::iterate_step) record_.ended(entered, entered, 0);
    fluid_ = given;
    message::Message message = message::lay_out(fluid_, terms_);
    shared_.confirm(message);
    record_.put_into_fluid(message);
    session_.prepare(message);
    session_.look_for_trouble("the fluid of its program");
    step_ = fluid_.step;
    pass_ = fluid_.pass;
    session_.set_step(step_.number);
    session_.advance(call);
    fluid_leaves_ = Clock::now();
    session_.send(std::move(message));
    terms_.memory.message_sent();
    Time const fluid_sent = Clock::now();
    clock_.sent(entered, fluid_sent);
    record_.began(step_.number, entered, fluid_sent);

    if (overlaps()) return;
    Time const arrival = take_solid();
    Time const left = Clock::now();
    double const waiting = clock_.answered_serial(left, solid_.busy_time);
    record_.began(step_.number, entered, left);
    record_.waited_in_begin(fluid_sent, arrival, waiting);
}

void ClientSession::end_step(Timings const& timings, double residual)
{
    Time const entered = Clock::now();
    session_.require(Event::end_step);
    session_.advance(Event::end_step);
    previous_ = timings;
    previous_residual_ = residual;

    if (!overlaps()) return record_.ended(entered, Clock::now(), 0);
    Time const arrival = take_solid();
    Time const left = Clock::now();
    record_.ended(entered, left, clock_.answered_overlapped(entered, arrival, left, solid_.busy_time));
}

/// Receives the solid of the current step; returns when it arrived.
Time ClientSession::take_solid()
{
    std::string const awaited =
        "step " + std::to_string(step_.number) + (pass_ > 0 ? ", pass " + std::to_string(pass_) : "");
    Letter letter = receive("SolidState of " + awaited);
    while (letter.message.kind() == message::Kind::kFluidWanted)
    {
        send_whole_fluid();
        letter = receive("SolidState of " + awaited);
    }
    v1::Envelope const& envelope = letter.message.envelope;
    if (envelope.step() != step_.number || envelope.iteration() != pass_)
        session_.fail(Fault::protocol, message::describe(letter.message) + " from " + session_.peer_name() +
                                           " is out of order (it should answer " + awaited +
                                           "); the two programs do not fit together, see docs/protocol.md");
    session_.read([&] { shared_.attach(letter.message); });
    solid_ = session_.read([&] { return message::unpack_solid_state(letter.message, terms_); });
    session_.read([&] { record_.heard(letter.message, fluid_leaves_, letter.arrival); });
    terms_.needed = solid_.cells.needed;
    solid_message_ = std::move(letter.message);
    return letter.arrival;
}

/// The same fluid again, with all cells.
void ClientSession::send_whole_fluid()
{
    terms_.needed.clear();
    message::Message message = message::lay_out(fluid_, terms_);
    shared_.confirm(message);
    record_.put_into_fluid(message);
    session_.prepare(message);
    session_.send(std::move(message));
    terms_.memory.message_sent();
}

}  // namespace gimdem::coupling::session

// SPDX-License-Identifier: BSD-3-Clause
/// Fluid and solid of each step.
#include <algorithm>
#include <utility>

#include "message/ClockMessages.hpp"
#include "message/StepMessages.hpp"
#include "session/ServerSession.hpp"

namespace gimdem::coupling::session
{

using transport::Clock;
using transport::seconds_between;

std::optional<FluidState> ServerSession::receive_fluid()
{
    Time const entered = Clock::now();
    session_.require(Event::receive_fluid);
    if (session_.state() == State::finished) return std::nullopt;

    Letter letter = receive("FluidState");
    for (; letter.message.kind() == message::Kind::kCheckpoint; letter = receive("FluidState"))
        save_checkpoint(letter);
    if (said_goodbye(letter)) return std::nullopt;

    session_.set_step(letter.message.envelope.step());
    session_.read([&] { shared_.attach(letter.message); });
    FluidState fluid = session_.read([&] { return message::unpack_fluid_state(letter.message, terms_); });
    check_order(fluid);
    pass_ = fluid.pass;
    if (auto outbox = shared_.use_if_confirmed(letter.message, terms_.memory)) session_.use(std::move(outbox));
    fluid_message_ = std::move(letter.message);
    busy_before_ = std::max(0.0, seconds_between(letter.arrival, entered));
    handed_out_ = Clock::now();
    times_.asked = transport::on_clock(entered);
    times_.arrived = transport::on_clock(letter.arrival);
    times_.handed_out = transport::on_clock(handed_out_);
    if (fluid.clock) session_.status_desk().publish(*fluid.clock);
    return fluid;
}

void ServerSession::ask_for_whole(FluidState const& fluid)
{
    if (fluid.is_complete) return;
    session_.require(Event::complete);
    session_.advance(Event::complete);
    session_.send(message::pack_fluid_wanted());
}

void ServerSession::take_whole(FluidState& fluid)
{
    if (fluid.is_complete) return;
    Letter letter = receive("the whole FluidState");
    session_.read([&] { shared_.attach(letter.message); });
    FluidState whole = session_.read([&] { return message::unpack_fluid_state(letter.message, terms_); });
    bool const is_same = whole.step.number == fluid.step.number && whole.step.time == fluid.step.time &&
                         whole.step.dt == fluid.step.dt && whole.pass == fluid.pass;
    if (!is_same || !whole.is_complete)
        session_.fail(Fault::protocol, message::describe(letter.message) + " from " + session_.peer_name() +
                                           " is not the whole fluid of step " + std::to_string(fluid.step.number) +
                                           " that was asked for; see docs/protocol.md");
    fluid.fields = whole.fields;
    fluid.is_complete = true;
    fluid_message_ = std::move(letter.message);
}

void ServerSession::wake_client()
{
    Time const entered = Clock::now();
    session_.announce_soon();
    waking_ += seconds_between(entered, Clock::now());
}

void ServerSession::send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells)
{
    times_.answering = clock_now();
    double const busy = busy_before_ + seconds_between(handed_out_, Clock::now()) - std::exchange(waking_, 0);
    session_.require(Event::send_solid);
    session_.announce_soon();
    message::Message solid = message::lay_out(message::SolidState{fields, timings, busy, stop_reason(), cells}, terms_);
    solid.envelope.set_iteration(pass_);
    message::put({times_.arrived, times_.answering, options_.clock_origin, 0}, solid);
    session_.prepare(solid);
    session_.look_for_trouble("the solid of its program");
    session_.advance(Event::send_solid);
    session_.send(std::move(solid));
    terms_.memory.message_sent();
    terms_.needed = cells.needed;
    times_.answered = clock_now();
}

void ServerSession::check_order(FluidState const& fluid)
{
    bool const repeats = fluid.pass > 0;
    auto fault = repeats ? order_.find_fault_of_repeat(fluid.step, fluid.pass) : order_.find_fault(fluid.step);
    if (repeats && !iterates_) fault = "it repeats a step, and the schedule is not iterated";
    if (fault)
        session_.fail(Fault::protocol, "FluidState from " + session_.peer_name() + " is out of order: " + *fault +
                                           "; check how the client counts its steps and its time");
    if (repeats)
        order_.accept_repeat(fluid.step, fluid.pass);
    else
        order_.accept(fluid.step);
}

}  // namespace gimdem::coupling::session

// SPDX-License-Identifier: BSD-3-Clause
#include "message/ClockMessages.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace gimdem::coupling::message
{
namespace
{

double constexpr lowest = std::numeric_limits<double>::lowest();

v1::ClockReading* place_in(Message& message)
{
    switch (message.kind())
    {
        case Kind::kHello:
            return message.envelope.mutable_hello()->mutable_clock();
        case Kind::kWelcome:
            return message.envelope.mutable_welcome()->mutable_clock();
        default:
            return message.envelope.mutable_solid_state()->mutable_clock();
    }
}

v1::ClockReading const* place_in(Message const& message)
{
    v1::Envelope const& envelope = message.envelope;
    if (envelope.has_hello() && envelope.hello().has_clock()) return &envelope.hello().clock();
    if (envelope.has_welcome() && envelope.welcome().has_clock()) return &envelope.welcome().clock();
    if (envelope.has_solid_state() && envelope.solid_state().has_clock()) return &envelope.solid_state().clock();
    return nullptr;
}

}  // namespace

std::uint64_t machine_number()
{
    std::string id;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), id);
    id.erase(std::remove(id.begin(), id.end(), '-'), id.end());
    return id.size() < 16 ? 0 : std::stoull(id.substr(0, 16), nullptr, 16);
}

void put(ClockReading const& reading, Message& message)
{
    v1::ClockReading& body = *place_in(message);
    body.set_received(reading.received);
    body.set_sent(reading.sent);
    body.set_origin(reading.origin);
    body.set_machine(reading.machine);
}

std::optional<ClockReading> clock_reading(Message const& message)
{
    v1::ClockReading const* const body = place_in(message);
    if (!body) return std::nullopt;
    check_number(body->received(), lowest, "clock: received");
    check_number(body->sent(), lowest, "clock: sent");
    check_number(body->origin(), lowest, "clock: origin");
    return ClockReading{body->received(), body->sent(), body->origin(), body->machine()};
}

void put(ClientTimes const& times, ClockOffset const& offset, v1::StepTimes& body)
{
    body.set_step(times.step);
    body.set_begun(times.begun);
    body.set_resumed(times.resumed);
    body.set_ended(times.ended);
    body.set_closed(times.closed);
    body.set_wait_from(times.wait_from);
    body.set_wait_to(times.wait_to);
    body.set_offset(offset.offset);
    body.set_uncertainty(offset.uncertainty);
}

ClientTimes unpack_times(v1::StepTimes const& body)
{
    check_number(body.begun(), lowest, "times: begun");
    check_number(body.resumed(), body.begun(), "times: resumed");
    check_number(body.ended(), body.resumed(), "times: ended");
    check_number(body.closed(), body.ended(), "times: closed");
    check_number(body.wait_from(), body.begun(), "times: wait_from");
    check_number(body.wait_to(), body.wait_from(), "times: wait_to");
    return {body.step(), body.begun(), body.resumed(), body.ended(), body.closed(), body.wait_from(), body.wait_to()};
}

ClockOffset unpack_offset(v1::StepTimes const& body)
{
    check_number(body.offset(), lowest, "times: offset");
    check_number(body.uncertainty(), 0, "times: uncertainty");
    return {body.offset(), body.uncertainty()};
}

std::optional<LastClientStep> unpack_last_step(Message const& message)
{
    v1::Goodbye const& goodbye = message.envelope.goodbye();
    if (!goodbye.has_last_step()) return std::nullopt;
    v1::LastStep const& last = goodbye.last_step();
    check_number(last.compute(), 0, "last step: compute");
    check_number(last.output(), 0, "last step: output");
    return LastClientStep{unpack_times(last.times()), {last.compute(), 0, last.output()}, unpack_offset(last.times())};
}

}  // namespace gimdem::coupling::message

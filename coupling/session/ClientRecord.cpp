// SPDX-License-Identifier: BSD-3-Clause
#include "session/ClientRecord.hpp"

#include <algorithm>
#include <cstdlib>

#include "message/ClockMessages.hpp"

namespace gimdem::coupling::session
{
namespace
{

using transport::on_clock;

std::unique_ptr<EventLog> log_of_environment()
{
    char const* const file = std::getenv(client_log_variable);
    if (file && *file) return std::make_unique<EventLog>(file, "client");
    return std::make_unique<EventLog>();
}

}  // namespace

ClientRecord::ClientRecord() : log_(log_of_environment()) {}

void ClientRecord::stamp(message::Message& hello)
{
    message::put({0, clock_now(), 0, message::machine_number()}, hello);
}

void ClientRecord::heard(message::Message const& message, Time sent, Time arrival)
{
    auto const reading = message::clock_reading(message);
    if (!reading) return;
    if (message.kind() == message::Kind::kWelcome && reading->machine != 0 &&
        reading->machine == message::machine_number())
        offset_.expect_one_clock();
    offset_.add(on_clock(sent), reading->received, reading->sent, on_clock(arrival));
    if (message.kind() == message::Kind::kWelcome && offset()) log_->set_origin(reading->origin + offset()->offset);
}

void ClientRecord::began(std::int64_t step, Time entered, Time left)
{
    current_ = {};
    current_.step = step;
    current_.begun = current_.wait_from = current_.wait_to = on_clock(entered);
    current_.resumed = on_clock(left);
}

// The way there and the way back are taken to be equal.
void ClientRecord::waited_in_begin(Time sent, Time arrival, double waiting)
{
    double const middle = 0.5 * (on_clock(sent) + on_clock(arrival));
    current_.wait_from = std::max(current_.begun, std::min(middle - 0.5 * waiting, current_.resumed - waiting));
    current_.wait_to = current_.wait_from + waiting;
}

void ClientRecord::ended(Time entered, Time left, double waiting)
{
    current_.ended = on_clock(entered);
    current_.closed = on_clock(left);
    if (waiting > 0)
    {
        current_.wait_from = current_.ended;
        current_.wait_to = current_.ended + waiting;
    }
    complete_ = current_;
}

void ClientRecord::put_into_fluid(message::Message& fluid) const
{
    if (!is_of_use()) return;
    message::put(complete_, *offset(), *fluid.envelope.mutable_fluid_state()->mutable_previous_times());
}

void ClientRecord::put_into_goodbye(message::Message& goodbye, Timings const& timings) const
{
    if (!is_of_use()) return;
    v1::LastStep& last = *goodbye.envelope.mutable_goodbye()->mutable_last_step();
    message::put(complete_, *offset(), *last.mutable_times());
    last.set_compute(timings.compute);
    last.set_output(timings.output);
}

}  // namespace gimdem::coupling::session

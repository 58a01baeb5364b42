// SPDX-License-Identifier: BSD-3-Clause
/// What a client remembers of itself for traces and logs: the stations of its steps, and the server's clock.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gimdem/coupling/EventLog.hpp"
#include "gimdem/coupling/StepTimes.hpp"
#include "message/Message.hpp"
#include "session/OffsetEstimate.hpp"
#include "transport/Clock.hpp"

namespace gimdem::coupling::session
{

using transport::Time;

/// Names the file of the client's structured log; unset: there is none.
inline constexpr char const* client_log_variable = "GIMDEM_CLIENT_LOG";

class ClientRecord
{
public:
    ClientRecord();

    /// Into Hello.
    void stamp(message::Message& hello);
    /// A Welcome or SolidState, which answers what was sent then. Fault::protocol for a clock that cannot be.
    void heard(message::Message const& message, Time sent, Time arrival);

    /// begin_step() was entered, its fluid was sent, the solid arrived where it was waited for, and it returns; so long
    /// of it the server's work was waited for [s].
    void began(std::int64_t step, Time entered, Time left);
    void waited_in_begin(Time sent, Time arrival, double waiting);
    /// The same of end_step(), which completes the step.
    void ended(Time entered, Time left, double waiting);

    /// Into FluidState and Goodbye: the last complete step, if the server can use it.
    void put_into_fluid(message::Message& fluid) const;
    void put_into_goodbye(message::Message& goodbye, Timings const& timings) const;

    std::optional<ClockOffset> offset() const { return offset_.at(clock_now()); }
    EventLog& log() { return *log_; }

private:
    bool is_of_use() const { return complete_.step != 0 && offset().has_value(); }

    std::unique_ptr<EventLog> log_;
    OffsetEstimate offset_;
    ClientTimes current_, complete_;
};

}  // namespace gimdem::coupling::session

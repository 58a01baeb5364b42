// SPDX-License-Identifier: BSD-3-Clause
/// Splits the wall time of the client's calls into exchange and waiting. No sockets: times go in.
#pragma once

#include <algorithm>

#include "gimdem/coupling/Client.hpp"
#include "transport/Clock.hpp"

namespace gimdem::coupling::session
{

using transport::Time;

/// The server reports how long it was busy with a step; what a round trip took beyond that is exchange. In the
/// overlapped schedule most of the busy time hides behind the client's own work, and only what end_step() is blocked
/// for counts as waiting.
class ExchangeClock
{
public:
    /// begin_step() was entered, and the fluid is on its way.
    void sent(Time entered, Time left)
    {
        sent_at_ = entered;
        packing_ = transport::seconds_between(entered, left);
    }

    /// Serial: begin_step() returns with the solid; the server was busy for so long [s]. Returns what of it was waiting
    /// [s].
    double answered_serial(Time left, double busy)
    {
        double const call = transport::seconds_between(sent_at_, left);
        double const waiting = std::min(call, busy);
        times_.waiting += waiting;
        times_.exchange += call - waiting;
        return waiting;
    }

    /// Overlapped: end_step() was entered, the solid had arrived or did so later, and end_step() returns. Returns what
    /// of it was waiting [s].
    double answered_overlapped(Time entered, Time arrival, Time left, double busy)
    {
        double const blocked = std::max(0.0, transport::seconds_between(entered, arrival));
        double const round_trip = transport::seconds_between(sent_at_, arrival);
        double const transfer = std::max(0.0, round_trip - busy - packing_);
        double const waiting = std::max(0.0, blocked - transfer);
        times_.waiting += waiting;
        times_.exchange += packing_ + transport::seconds_between(entered, left) - waiting;
        return waiting;
    }

    void set_bytes(double bytes) { times_.bytes = bytes; }
    ExchangeTimes const& times() const { return times_; }

private:
    ExchangeTimes times_;
    Time sent_at_;
    double packing_ = 0;  ///< what begin_step() took to pack and send [s]
};

}  // namespace gimdem::coupling::session

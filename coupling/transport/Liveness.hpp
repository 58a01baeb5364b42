// SPDX-License-Identifier: BSD-3-Clause
/// When to send the next heartbeat, and when a silent peer counts as dead. No sockets, no threads: times go in.
#pragma once

#include <optional>

#include "transport/Clock.hpp"

namespace gimdem::coupling::transport
{

/// Watches one peer from its first message on.
class Liveness
{
public:
    /// timeout: a peer silent for this long is dead [s].
    Liveness(double timeout, Time now);

    /// The peer has spoken. The first time, a heartbeat is due at once.
    void heard(Time now);
    bool has_contact() const { return contact_; }

    /// The peer loses patience after this long [s]: beat five times as often, whatever our own time-out is.
    void set_peer_timeout(double timeout);

    bool beat_due(Time now) const { return contact_ && now >= next_beat_; }
    void beaten(Time now) { next_beat_ = now + interval_; }

    /// Call once per turn of the polling loop. A turn that took far longer than planned means that this process was
    /// itself stopped or starved: then the silence was ours, and the peer gets its full time anew.
    void turn(Time now);

    /// How long the peer has been silent, if that is too long [s].
    std::optional<double> silence(Time now) const;

    /// The polling loop must turn again by then.
    Time next_turn(Time now) const;

private:
    Clock::duration timeout_;
    Clock::duration interval_;  ///< between heartbeats
    Time last_heard_;
    Time last_turn_;
    Time next_beat_;
    bool contact_ = false;
};

}  // namespace gimdem::coupling::transport

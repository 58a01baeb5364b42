// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Liveness.hpp"

#include <algorithm>

namespace gimdem::coupling::transport
{
namespace
{

/// Four heartbeats may be lost in the crowd before the peer loses patience.
double constexpr beats_per_timeout = 5;

}  // namespace

Liveness::Liveness(double timeout, Time now)
    : timeout_(ticks(timeout)),
      interval_(ticks(timeout / beats_per_timeout)),
      last_heard_(now),
      last_turn_(now),
      next_beat_(now)
{
}

void Liveness::heard(Time now)
{
    if (!contact_) next_beat_ = now;
    contact_ = true;
    last_heard_ = now;
}

void Liveness::set_peer_timeout(double timeout)
{
    Clock::duration const wanted = ticks(timeout / beats_per_timeout);
    if (wanted >= interval_) return;
    next_beat_ -= interval_ - wanted;
    interval_ = wanted;
}

void Liveness::turn(Time now)
{
    bool const was_stopped = now - last_turn_ > 3 * interval_;
    if (was_stopped) last_heard_ = now;
    last_turn_ = now;
}

std::optional<double> Liveness::silence(Time now) const
{
    if (!contact_ || now - last_heard_ <= timeout_) return std::nullopt;
    return seconds_between(last_heard_, now);
}

Time Liveness::next_turn(Time now) const
{
    Time next = now + interval_;
    if (contact_) next = std::min(next, next_beat_);
    Time const end_of_patience = last_heard_ + timeout_;
    if (contact_ && end_of_patience > now) next = std::min(next, end_of_patience);
    return next;
}

}  // namespace gimdem::coupling::transport

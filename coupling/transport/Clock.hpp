// SPDX-License-Identifier: BSD-3-Clause
/// The clock of every time-out: steady, so that setting the wall clock kills no run.
#pragma once

#include <algorithm>
#include <chrono>

namespace gimdem::coupling::transport
{

using Clock = std::chrono::steady_clock;
using Time = Clock::time_point;
using Seconds = std::chrono::duration<double>;

/// The clock's own ticks for a number of seconds; anything beyond thirty years counts as thirty years.
inline Clock::duration ticks(double seconds)
{
    double constexpr thirty_years = 1e9;
    return std::chrono::duration_cast<Clock::duration>(Seconds(std::clamp(seconds, 0.0, thirty_years)));
}

/// Seconds from one time to another [s].
inline double seconds_between(Time from, Time to)
{
    return Seconds(to - from).count();
}

/// What the clock shows [s].
inline double on_clock(Time time)
{
    return Seconds(time.time_since_epoch()).count();
}

}  // namespace gimdem::coupling::transport

// SPDX-License-Identifier: BSD-3-Clause
/// When the stations of a step were passed, for traces. All times are of a monotonic clock [s], whose zero is the
/// machine's affair: only differences mean something. docs/protocol.md, Clocks.
#pragma once

#include <cstdint>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling
{

/// Of a client's step, by the client's clock.
struct ClientTimes
{
    std::int64_t step = 0;  ///< 0: there is none yet
    double begun = 0;       ///< begin_step() was called [s]
    double resumed = 0;     ///< begin_step() returned, and the fluid step began [s]
    double ended = 0;       ///< the fluid step was over: end_step() was called [s]
    double closed = 0;      ///< end_step() returned [s]
    double wait_from = 0;   ///< blocked by the server's work from here [s]
    double wait_to = 0;     ///< to here; within [begun, resumed] or [ended, closed] [s]
};

/// Of a server's step, by the server's clock.
struct ServerTimes
{
    double asked = 0;       ///< receive_fluid() was called [s]
    double arrived = 0;     ///< the fluid was here, perhaps before it was asked for [s]
    double handed_out = 0;  ///< receive_fluid() returned [s]
    double answering = 0;   ///< send_solid() was called [s]
    double answered = 0;    ///< send_solid() returned [s]
};

/// Two clocks side by side.
struct ClockOffset
{
    double offset = 0;       ///< the client's clock minus the server's [s]
    double uncertainty = 0;  ///< the true offset differs by this at most [s]
};

/// What Goodbye tells of the client's last step.
struct LastClientStep
{
    ClientTimes times;
    Timings timings;
    ClockOffset clock;
};

/// This machine's monotonic clock [s].
double clock_now();

}  // namespace gimdem::coupling

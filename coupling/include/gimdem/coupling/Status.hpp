// SPDX-License-Identifier: BSD-3-Clause
/// How a run stands: what a server's program publishes, and what anybody may ask a server for.
///
///     Status const status = query_status("ipc:///tmp/run/socket", 5);
///
/// The question opens no session and changes nothing: a thread of the server answers it, also while its program
/// computes or hangs. A server answers 20 questions a second and lets the others lie.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "gimdem/coupling/StepTimes.hpp"
#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling
{

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// What the server's program tells of its run. Numbers may be not_known.
struct RunStatus
{
    std::string title;     ///< of the case
    std::string activity;  ///< what the program is doing, in words
    std::string folder;    ///< of the run
    std::string schedule;
    double time = not_known;                ///< simulated, at the end of the last step [s]
    double end_time = not_known;            ///< the run ends here [s]
    double steps_per_second = not_known;    ///< coupling steps per wall time, lately [1/s]
    double wall_per_simulated = not_known;  ///< wall time per simulated time, lately [1]
    std::vector<Monitor> figures;           ///< of the last step

    /// Wall time left [s], if the speed stays.
    double time_left() const { return (end_time - time) * wall_per_simulated; }
};

/// The answer to query_status().
struct Status
{
    RunStatus run;
    std::string server;                 ///< name and version
    std::string protocol;               ///< "1.1"
    std::string state;                  ///< of the session, docs/protocol.md
    double state_time = not_known;      ///< in that state for so long [s]
    std::int64_t step = 0;              ///< where the server is
    double uptime = not_known;          ///< listening for so long [s]
    double memory = not_known;          ///< resident, of the server's process [B]
    std::int64_t process = 0;           ///< number of the server's process on its machine
    std::string client;                 ///< name; empty: there is none
    std::string client_state;           ///< as it last told
    double client_silence = not_known;  ///< since it was last heard [s]
    ClockOffset clock{0, not_known};    ///< of client and server
};

/// Asks the server at that endpoint. keys: folder of keys of a client, gimdem/coupling/Keys.hpp, for a server that has
/// some. CouplingError: endpoint (nobody listens there), protocol (not a gimdem server), user (it does not let our key
/// in), version, or timeout (no answer within so many seconds).
Status query_status(std::string const& endpoint, double timeout, std::string const& keys = "");

}  // namespace gimdem::coupling

// SPDX-License-Identifier: BSD-3-Clause
/// Where clients are met: the first one, and one that comes back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "app/RunEvents.hpp"
#include "core/Case.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::app
{

class CoupledRun;

/// Holds the server's end of the wire. A session serves one client, so one that comes back is met by a new session at
/// the same address.
class Reception
{
public:
    Reception(Case const& settings, std::filesystem::path const& folder, RunEvents& events,
              coupling::Server::CheckpointSaver saver);

    /// The same object for all sessions.
    coupling::Server& server() { return *server_; }

    /// The first client.
    coupling::ClientInfo meet();

    /// The client was lost, for this reason. Waits for it to come back, `grace_time` [s] at most, and has the run go on
    /// from its checkpoint; whoever else comes is turned away. False: it has not come.
    bool meet_again(CoupledRun& run, double grace_time, std::string const& reason);

private:
    void open(std::string const& endpoint, double patience);
    void go_on(CoupledRun& run);

    Case const& settings_;
    std::filesystem::path folder_;
    RunEvents& events_;
    coupling::Server::CheckpointSaver saver_;
    std::optional<coupling::Server> server_;
    std::set<std::uint64_t> sessions_;  ///< of this run so far
};

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
/// One session of the client under trial with a mock server, from outside.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conformance/Findings.hpp"
#include "conformance/MockServer.hpp"

namespace gimdem::conformance
{

struct TrialOptions
{
    std::vector<std::string> command;  ///< of the client; {endpoint} in it is replaced
    std::string folder;                ///< for the socket, findings and outputs
    std::string only;                  ///< name of the one trial to run; empty: all
    bool tcp = false;
    double patience = 10;  ///< for the client to end once the server has or misbehaved [s]
    double limit = 120;    ///< of a whole session [s]
};

struct TrialResult
{
    std::vector<Finding> findings;
    std::optional<int> exit_code;   ///< of the client; 128 + signal; empty: it hung and was killed
    double late = 0;                ///< from the misbehaviour, or the server's end, to the client's end [s]
    std::string output;             ///< of the client
    std::optional<double> timeout;  ///< of the client, where it was told [s]
    std::string insists_on;         ///< a schedule, or empty
    bool iterates = false;          ///< it can
};

/// extra: patience beyond the usual [s].
TrialResult run_trial(TrialOptions const& options, Script script, std::string const& name, double extra = 0);

/// The last line of a text that is not empty.
std::string last_line(std::string const& text);

}  // namespace gimdem::conformance

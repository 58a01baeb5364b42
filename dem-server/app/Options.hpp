// SPDX-License-Identifier: BSD-3-Clause
/// Command line of gimdem-server.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/Case.hpp"
#include "output/StepTrace.hpp"

namespace gimdem::app
{

struct Options
{
    std::filesystem::path case_file;
    std::filesystem::path run_folder = ".";  ///< results go here
    bool describe = false;                   ///< print the case as JSON and stop
    std::optional<std::string> endpoint, schedule, device, precision;
    std::optional<double> until, grace_time;  ///< [s]
    std::optional<int> threads;
    std::optional<std::filesystem::path> keys;     ///< folder, docs/security.md
    std::optional<std::filesystem::path> restart;  ///< checkpoint to go on from
    output::TraceChoice trace;
    std::vector<std::string> encodings;  ///< of the fields; empty: as the case file says
    std::optional<std::string> status;   ///< ask the server at this endpoint how its run stands, and stop
    bool json = false;                   ///< the answer for programs
    double patience = 5;                 ///< for the answer [s]
};

/// Empty when the program has nothing to do (help, version, wrong usage): exit_code tells the status.
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

/// The case with the options' values in place of the file's.
Case read_case_with(Options const& options);

}  // namespace gimdem::app

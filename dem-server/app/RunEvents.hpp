// SPDX-License-Identifier: BSD-3-Clause
/// The structured log of a run.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

#include "gimdem/coupling/EventLog.hpp"
#include "output/SpeedMeter.hpp"

namespace gimdem::app
{

/// When this process began, which is when its run began, by coupling::clock_now() [s].
double clock_origin();

/// log.jsonl of a run folder.
class RunEvents
{
public:
    /// Throws CouplingError if the file cannot be made.
    explicit RunEvents(std::filesystem::path const& folder);

    /// The same words on the terminal and in the log.
    void say(char const* event, std::string const& message, std::initializer_list<coupling::EventField> fields = {});
    /// In the log alone.
    void note(char const* event, std::string const& message, std::initializer_list<coupling::EventField> fields = {});
    void warn(char const* event, std::string const& message);
    void fail(std::string const& reason);
    /// How far the run is; in the log every ten seconds.
    void progress(double time, double until, output::SpeedMeter const& speed);

private:
    coupling::EventLog log_;
    double next_progress_ = 0;  ///< by clock_now() [s]
};

}  // namespace gimdem::app

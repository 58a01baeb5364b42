// SPDX-License-Identifier: BSD-3-Clause
#include "app/RunEvents.hpp"

#include <fmt/format.h>

#include "gimdem/coupling/StepTimes.hpp"

namespace gimdem::app
{

namespace
{

double constexpr progress_interval = 10;  ///< [s]
double const process_start = coupling::clock_now();

}  // namespace

double clock_origin()
{
    return process_start;
}

RunEvents::RunEvents(std::filesystem::path const& folder) : log_((folder / "log.jsonl").string(), "server")
{
    log_.set_origin(clock_origin());
}

void RunEvents::say(char const* event, std::string const& message, std::initializer_list<coupling::EventField> fields)
{
    fmt::print(stderr, "gimdem-server: {}\n", message);
    log_.write(coupling::LogLevel::info, event, message, fields);
}

void RunEvents::note(char const* event, std::string const& message, std::initializer_list<coupling::EventField> fields)
{
    log_.write(coupling::LogLevel::info, event, message, fields);
}

void RunEvents::warn(char const* event, std::string const& message)
{
    fmt::print(stderr, "gimdem-server: note: {}\n", message);
    log_.write(coupling::LogLevel::warning, event, message);
}

void RunEvents::fail(std::string const& reason)
{
    log_.write(coupling::LogLevel::error, "fault", reason);
}

void RunEvents::progress(double time, double until, output::SpeedMeter const& speed)
{
    double const now = coupling::clock_now();
    if (now < next_progress_) return;
    next_progress_ = now + progress_interval;
    log_.write(coupling::LogLevel::info, "progress", fmt::format("t = {:.4f} of {:g} s", time, until),
               {{"time_s", time},
                {"end_time_s", until},
                {"steps_per_second", speed.steps_per_second()},
                {"wall_per_simulated", speed.wall_per_simulated()}});
}

}  // namespace gimdem::app

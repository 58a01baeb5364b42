// SPDX-License-Identifier: BSD-3-Clause
#include "app/StatusCommand.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "output/Text.hpp"

namespace gimdem::app
{

namespace
{

using coupling::json_number;
using output::duration_text;
using output::json_quoted;

std::string line(char const* label, std::string const& text)
{
    return text.empty() ? "" : fmt::format("{:<10}{}\n", label, text);
}

std::string time_text(coupling::RunStatus const& run)
{
    if (std::isnan(run.time)) return "";
    std::string text = fmt::format("t = {:.6g} of {:g} s", run.time, run.end_time);
    if (std::isfinite(run.time_left())) text += ", left " + duration_text(run.time_left());
    return text;
}

std::string speed_text(coupling::RunStatus const& run)
{
    if (std::isnan(run.steps_per_second)) return "";
    return fmt::format("{:.3g} steps/s, {:.3g} s per simulated second", run.steps_per_second, run.wall_per_simulated);
}

std::string client_text(coupling::Status const& status)
{
    if (status.client.empty()) return "none yet";
    std::string text = status.client;
    if (!status.client_state.empty()) text += ", " + status.client_state;
    if (std::isfinite(status.client_silence)) text += fmt::format(", heard {:.1f} s ago", status.client_silence);
    if (status.clock.uncertainty > 0)
        text += fmt::format(", its clock {:+.2e} s off (+-{:.1e} s)", status.clock.offset, status.clock.uncertainty);
    return text;
}

}  // namespace

std::string status_text(coupling::Status const& status)
{
    coupling::RunStatus const& run = status.run;
    std::string text = line("server", fmt::format("{}, process {}, {:.0f} MB, up {}", status.server, status.process,
                                                  1e-6 * status.memory, duration_text(status.uptime)));
    text += line("case", run.title + (run.schedule.empty() ? "" : " (" + run.schedule + ")"));
    text += line("folder", run.folder);
    text += line("doing", run.activity);
    text += line("state", fmt::format("{}, step {}, for {:.3g} s", status.state, status.step, status.state_time));
    text += line("time", time_text(run)) + line("speed", speed_text(run)) + line("client", client_text(status));
    for (coupling::Monitor const& figure : run.figures)
        text += fmt::format("  {} = {:.6g} [{}]\n", figure.name, figure.value, figure.unit);
    return text;
}

std::string status_json(coupling::Status const& status)
{
    coupling::RunStatus const& run = status.run;
    std::string figures;
    for (coupling::Monitor const& figure : run.figures)
        figures += fmt::format(R"({}{{"name": {}, "value": {}, "unit": {}}})", figures.empty() ? "" : ", ",
                               json_quoted(figure.name), json_number(figure.value), json_quoted(figure.unit));
    std::string out = R"({"live": true)";
    auto const text = [&](char const* name, std::string const& value)
    { out += fmt::format(R"(, "{}": {})", name, json_quoted(value)); };
    auto const number = [&](char const* name, double value)
    { out += fmt::format(R"(, "{}": {})", name, json_number(value)); };
    text("server", status.server);
    text("protocol", status.protocol);
    text("state", status.state);
    number("state_time_s", status.state_time);
    number("step", static_cast<double>(status.step));
    text("activity", run.activity);
    text("title", run.title);
    text("folder", run.folder);
    text("schedule", run.schedule);
    number("time_s", run.time);
    number("end_time_s", run.end_time);
    number("time_left_s", run.time_left());
    number("steps_per_second", run.steps_per_second);
    number("wall_per_simulated", run.wall_per_simulated);
    number("uptime_s", status.uptime);
    number("memory_bytes", status.memory);
    number("process", static_cast<double>(status.process));
    text("client", status.client);
    text("client_state", status.client_state);
    number("client_silence_s", status.client_silence);
    number("clock_offset_s", status.clock.offset);
    number("clock_uncertainty_s", status.clock.uncertainty);
    return out + R"(, "figures": [)" + figures + "]}";
}

void print_status(std::string const& endpoint, double timeout, std::string const& keys, bool as_json)
{
    coupling::Status const status = coupling::query_status(endpoint, timeout, keys);
    std::cout << (as_json ? status_json(status) + "\n" : status_text(status)) << std::flush;
}

}  // namespace gimdem::app

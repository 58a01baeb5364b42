// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/Trial.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "conformance/ClientProcess.hpp"

namespace gimdem::conformance
{
namespace
{

using Clock = std::chrono::steady_clock;

double constexpr look_interval = 0.02;  ///< [s]
double constexpr server_start = 20;     ///< longest wait for the mock server to bind [s]

void pause()
{
    std::this_thread::sleep_for(std::chrono::duration<double>(look_interval));
}

double seconds_since(Clock::time_point time)
{
    return std::chrono::duration<double>(Clock::now() - time).count();
}

ChildProcess start_server(Script const& script, std::string const& file_name)
{
    return ChildProcess::fork(
        [&]
        {
            std::FILE* const file = std::fopen(file_name.c_str(), "w");
            if (file == nullptr) return 2;
            FindingsFile findings(file);
            try
            {
                return play(script, findings) ? 0 : 1;
            }
            catch (std::exception const& error)
            {
                findings.fail("server", error.what());
                return 1;
            }
        });
}

std::string wait_for_endpoint(std::string const& file_name)
{
    for (auto const start = Clock::now(); seconds_since(start) < server_start; pause())
        if (auto const endpoint = read_fact(file_name, "endpoint")) return *endpoint;
    throw std::runtime_error("the mock server did not start; is the folder for temporary files writable?");
}

std::vector<std::string> with_endpoint(std::vector<std::string> command, std::string const& endpoint)
{
    std::string const place = "{endpoint}";
    for (std::string& word : command)
        if (auto const at = word.find(place); at != std::string::npos) word.replace(at, place.size(), endpoint);
    return command;
}

std::string contents(std::string const& file_name)
{
    std::ifstream file(file_name);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Waits for the client's end, as long as it may take; how late it ended is in the result.
void watch(ChildProcess& server, ChildProcess& client, std::string const& file_name, TrialOptions const& options,
           double patience, TrialResult& result)
{
    auto const start = Clock::now();
    std::optional<Clock::time_point> over;
    while (!(result.exit_code = client.exit_code()))
    {
        bool const ended = server.exit_code() || server.was_stopped() || read_fact(file_name, "misbehaved");
        if (ended && !over) over = Clock::now();
        // After a late answer the session goes on; its limit counts.
        if (over && seconds_since(*over) > patience) break;
        if (seconds_since(start) > options.limit) break;
        pause();
    }
    if (over) result.late = seconds_since(*over);
}

}  // namespace

TrialResult run_trial(TrialOptions const& options, Script script, std::string const& name, double extra)
{
    std::string const base = options.folder + "/" + name;
    script.endpoint = options.tcp ? "tcp://127.0.0.1:*" : "ipc://" + base + ".socket";
    TrialResult result;
    ChildProcess server = start_server(script, base + ".findings");
    std::string const endpoint = wait_for_endpoint(base + ".findings");
    ChildProcess client = ChildProcess::start(with_endpoint(options.command, endpoint), base + ".output");
    watch(server, client, base + ".findings", options, options.patience + extra, result);
    client.kill();
    // What it has to say after the client's last words.
    for (auto const start = Clock::now(); !server.exit_code() && !server.was_stopped() && seconds_since(start) < 2;)
    {
        if (script.misbehaviour == Misbehaviour::wrong_version || script.misbehaviour == Misbehaviour::truncate) break;
        pause();
    }
    server.kill();
    result.findings = read_findings(base + ".findings");
    result.output = contents(base + ".output");
    if (auto const timeout = read_fact(base + ".findings", "timeout")) result.timeout = std::atof(timeout->c_str());
    result.insists_on = read_fact(base + ".findings", "schedule").value_or("");
    result.iterates = read_fact(base + ".findings", "iterates").has_value();
    return result;
}

std::string last_line(std::string const& text)
{
    auto const end = text.find_last_not_of(" \n");
    if (end == std::string::npos) return "";
    auto const start = text.rfind('\n', end);
    return text.substr(start == std::string::npos ? 0 : start + 1, end - (start == std::string::npos ? -1 : start));
}

}  // namespace gimdem::conformance

// SPDX-License-Identifier: BSD-3-Clause
#include "app/Options.hpp"

#include <CLI/CLI.hpp>
#include <cmath>

#include "core/Error.hpp"
#include "exec/Execution.hpp"

namespace gimdem::app
{

namespace
{

/// The case file's backend, or another where it is not one of the device.
std::string backend_on(std::string const& device, std::string const& backend)
{
    bool const on_gpu = device == "cuda" || (device == "auto" && exec::cuda_is_there());
    if (on_gpu) return "cuda";
    return backend == "cuda" ? "openmp" : backend;
}

}  // namespace

std::optional<Options> parse_options(int argc, char** argv, int& exit_code)
{
    Options options;
    CLI::App app("gimdem-server: moves the particles of a case and maps them onto the client's mesh");
    app.set_version_flag("--version", "gimdem-server " GIMDEM_VERSION);
    app.add_option("--case", options.case_file, "case file (case.toml)");
    app.add_option("--run", options.run_folder, "folder for the results");
    app.add_flag("--describe", options.describe, "check the case file, print what it says as JSON, and stop");
    app.add_option("--endpoint", options.endpoint, "ipc:///path/socket or tcp://127.0.0.1:port");
    app.add_option("--keys", options.keys, "folder of keys, made by ./gimdem keys");
    app.add_option("--schedule", options.schedule, "serial, overlapped or iterated")
        ->check(CLI::IsMember({"serial", "overlapped", "iterated"}));
    app.add_option("--until", options.until, "simulated time [s]")->check(CLI::PositiveNumber);
    app.add_option("--threads", options.threads, "threads for the particles, 0: all cores")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--device", options.device,
                   "where the particles are computed: cuda, cpu, or auto: cuda if it is there")
        ->check(CLI::IsMember({"auto", "cuda", "cpu"}));
    app.add_option("--precision", options.precision, "of the contact laws: double or mixed")
        ->check(CLI::IsMember({"double", "mixed"}));
    app.add_option("--restart", options.restart, "checkpoint to go on from");
    app.add_option("--grace-time", options.grace_time,
                   "how long a client that was lost may take to come back to its last checkpoint [s]; 0: it may not")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--encoding", options.encodings,
                   "how fields travel, where the client can: sparse, float32, lz4, several of them, or dense")
        ->check(CLI::IsMember({"dense", "sparse", "float32", "lz4"}));
    app.add_option("--trace-steps", options.trace.steps, "write trace.json of so many steps, for Perfetto")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--trace-every", options.trace.every, "of every so many steps")->check(CLI::PositiveNumber);
    app.add_option("--status", options.status, "ask the server at this endpoint how its run stands, and stop");
    app.add_flag("--json", options.json, "the status as JSON");
    app.add_option("--patience", options.patience, "wait so long for the status [s]")->check(CLI::PositiveNumber);
    try
    {
        app.parse(argc, argv);
        if (options.case_file.empty() && !options.status) throw CLI::RequiredError("--case");
    }
    catch (CLI::ParseError const& error)
    {
        exit_code = app.exit(error);
        if (exit_code != 0) exit_code = 2;
        return {};
    }
    return options;
}

Case read_case_with(Options const& options)
{
    Case settings = read_case(options.case_file);
    if (options.endpoint) settings.coupling.endpoint = *options.endpoint;
    if (options.keys) settings.coupling.keys = std::filesystem::absolute(*options.keys);
    if (options.grace_time) settings.coupling.grace_time = *options.grace_time;
    if (!options.encodings.empty()) settings.coupling.encodings = options.encodings;
    if (options.schedule) settings.coupling.schedule = *options.schedule;
    if (options.until)
    {
        if (!std::isfinite(*options.until)) throw UserError("--until must be a finite time [s]");
        settings.run.until = *options.until;
    }
    if (options.threads) settings.dem.threads = *options.threads;
    if (options.precision) settings.dem.precision = *options.precision;
    if (options.device) settings.dem.backend = backend_on(*options.device, settings.dem.backend);
    return settings;
}

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
/// The real gimdem-server on a small case in a folder of its own.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "BoxMesh.hpp"
#include "Endpoint.hpp"
#include "Process.hpp"
#include "TemporaryFolder.hpp"
#include "gimdem/coupling/Client.hpp"

namespace gimdem::test
{

/// Generous for a busy machine, and far below the time-outs of tests that must not wait for one [s].
inline constexpr double soon = 10;
inline constexpr double patient = 40;  ///< time-out of tests that must not see one [s]

/// 300 beads, far apart and at rest in a box without gravity: nothing but drag changes their momentum.
struct SmallCase
{
    double timeout = patient;       ///< of the server [s]
    double connect_time = patient;  ///< of the server [s]
    std::string schedule = "serial";
    std::string more;                    ///< of the case file
    std::string coupling;                ///< more of its [coupling]
    std::vector<std::string> arguments;  ///< of the server, beside the usual ones

    static constexpr int particle_count = 300;
    static constexpr double diameter = 2e-3;          ///< [m]
    static constexpr double particle_density = 1000;  ///< [kg/m^3]

    static coupling::Mesh mesh() { return BoxMesh::make({4, 4, 8}, {0.06, 0.06, 0.12}); }
    static constexpr double cell_volume = 0.06 * 0.06 * 0.12 / (4 * 4 * 8);  ///< [m^3]

    std::string text() const
    {
        return "title = \"a small box\"\n"
               "[run]\nuntil = 1.0\n"
               "[coupling]\nschedule = \"" +
               schedule + "\"\ntimeout = " + std::to_string(timeout) +
               "\nconnect_time = " + std::to_string(connect_time) + "\n" + coupling +
               "[dem]\ntime_step = 1e-5\ngravity = [0.0, 0.0, 0.0]\nthreads = 1\n"
               "[[materials]]\nname = \"bead\"\ndensity = 1000.0\nyoung_modulus = 1e6\npoisson_ratio = 0.3\n"
               "[[contacts]]\npair = [\"bead\", \"bead\"]\nrestitution = 0.9\nfriction = 0.3\n"
               "[walls]\nmaterial = \"bead\"\n"
               "[[insertion]]\nmaterial = \"bead\"\ndiameter = 2e-3\ncount = 300\narrangement = \"lattice\"\n"
               "box = [[0.006, 0.006, 0.01], [0.054, 0.054, 0.11]]\nspacing = 6e-3\njitter = 5e-4\n"
               "[fluid_forces]\ndrag = \"beetstra\"\npressure_gradient = false\n"
               "[mapping]\nmethod = \"gim\"\n"
               "[output]\nparticle_interval = 0.0\n" +
               more;
    }
};

class ServerProcess
{
public:
    /// given: an endpoint that it may choose the port of.
    explicit ServerProcess(std::string const& given, SmallCase const& settings = {})
        : ServerProcess(given, settings.text(), settings.arguments)
    {
    }
    /// The same with a case file of this text.
    ServerProcess(std::string const& given, std::string const& text, std::vector<std::string> const& arguments = {})
        : process_(command(folder_, given, text, arguments), folder_ / "output.txt")
    {
    }

    Process& process() { return process_; }
    std::filesystem::path result(std::string const& name) const { return folder_ / "run/" / name; }

    /// Its checkpoints, oldest first.
    std::vector<std::filesystem::path> checkpoints() const
    {
        std::vector<std::filesystem::path> files;
        for (auto const& entry : std::filesystem::directory_iterator(result("checkpoints")))
            files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        return files;
    }

    /// The address that it is bound to, once it is.
    std::string endpoint() const
    {
        std::string const before = "waiting for a client at ";
        EXPECT_TRUE(process_.wait_for_output(before, soon)) << process_.output();
        wait_until([&] { return line_after(before).second; }, soon);
        return line_after(before).first;
    }

    /// It must end by itself, with this exit code and this text; and leave no socket file behind.
    void expect_end(int exit_code, std::string const& part, double seconds = soon)
    {
        auto const code = process_.wait(seconds);
        EXPECT_EQ(code, exit_code) << "the server did not end as it should: " << process_.output();
        EXPECT_THAT(process_.output(), testing::HasSubstr(part));
        std::string const address = line_after("waiting for a client at ").first;
        if (address.rfind("ipc://", 0) != 0) return;
        EXPECT_FALSE(std::filesystem::exists(file_of(address)));
        EXPECT_FALSE(std::filesystem::exists(file_of(address) + ".lock"));
    }

private:
    static std::vector<std::string> command(TemporaryFolder const& folder, std::string const& endpoint,
                                            std::string const& text, std::vector<std::string> const& arguments)
    {
        std::ofstream(folder / "case.toml") << text;
        std::vector<std::string> all{GIMDEM_SERVER, "--case", folder / "case.toml", "--run", folder / "run",
                                     "--endpoint",  endpoint};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return all;
    }

    /// The rest of the line after that text, and whether the line is complete.
    std::pair<std::string, bool> line_after(std::string const& before) const
    {
        std::string const output = process_.output();
        auto const start = output.find(before);
        if (start == std::string::npos) return {"", false};
        auto const end = output.find('\n', start);
        auto const from = start + before.size();
        return {output.substr(from, end == std::string::npos ? end : end - from), end != std::string::npos};
    }

    TemporaryFolder folder_;
    Process process_;
};

inline coupling::ClientOptions client_options(std::string const& endpoint, double timeout = patient)
{
    coupling::ClientOptions options;
    options.endpoint = endpoint;
    options.name = "scripted client";
    options.timeout = timeout;
    options.connect_time = patient;
    options.step_time = patient;
    options.wants = {coupling::field::void_fraction, coupling::field::momentum_source,
                     coupling::field::drag_coefficient, coupling::field::drag_momentum};
    return options;
}

/// The transports that each test runs over.
inline std::string endpoint_over(std::string const& transport)
{
    return transport == "ipc" ? unused_ipc_endpoint() : any_tcp_endpoint();
}

}  // namespace gimdem::test

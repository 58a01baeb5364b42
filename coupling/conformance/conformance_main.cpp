// SPDX-License-Identifier: BSD-3-Clause
/// gimdem-conformance: proves that a client keeps the protocol; docs/write-a-client.md.
///
/// Usage: gimdem-conformance [options] -- CLIENT ... {endpoint} ...
/// Exit codes: 0 nothing failed, 1 something did, 2 wrong usage.
#include <stdlib.h>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "conformance/Trials.hpp"

namespace
{

using namespace gimdem::conformance;

/// Removed with its contents at the end.
class TemporaryFolder
{
public:
    TemporaryFolder()
    {
        std::string const parent = std::filesystem::temp_directory_path().string();
        path_ = parent + "/gimdem-conformance-XXXXXX";
        if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error(parent + " is not writable");
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;
    std::string const& path() const { return path_; }

private:
    std::string path_;
};

int run(TrialOptions options, Script const& script)
{
    TemporaryFolder const folder;
    options.folder = folder.path();
    std::map<Verdict, int> counts;
    try_client(options, script,
               [&](Finding const& finding)
               {
                   ++counts[finding.verdict];
                   std::printf("%-7s %-26s %s\n", word_of(finding.verdict), finding.name.c_str(), finding.text.c_str());
                   std::fflush(stdout);
               });
    std::printf("\n%d ok, %d failed, %d not shown\n", counts[Verdict::passed], counts[Verdict::failed],
                counts[Verdict::skipped]);
    if (counts.empty())
        throw std::runtime_error("there is no trial \"" + options.only + "\"; leave out --only to see all");
    return counts[Verdict::failed] == 0 ? 0 : 1;
}

bool has_place_for_endpoint(std::vector<std::string> const& command)
{
    for (std::string const& word : command)
        if (word.find("{endpoint}") != std::string::npos) return true;
    return false;
}

}  // namespace

int main(int argc, char** argv)
{
    TrialOptions options;
    Script script;
    CLI::App app(
        "gimdem-conformance: starts a client against a mock server, again and again, and tells what it proved");
    app.footer("Example: gimdem-conformance -- ./my-client {endpoint} run-folder");
    app.add_option("--until", script.end_time,
                   "end time of a session; a few steps of the client are enough (0.01) [s]");
    app.add_option("--axis", script.law.axis, "direction of the force on the fluid (0 0 1)");
    app.add_option("--momentum", script.law.momentum, "size of that force per volume (2) [N/m^3]");
    app.add_option("--drag", script.law.drag, "drag coefficient (100) [kg/(m^3 s)]");
    app.add_option("--only", options.only, "run this trial alone, e.g. \"lost server\"");
    app.add_flag("--tcp", options.tcp, "meet at tcp://127.0.0.1 instead of an ipc socket");
    app.add_option("--patience", options.patience, "for the client to end once it has to (10) [s]");
    app.add_option("--limit", options.limit, "of one session (120) [s]");
    app.add_option("client", options.command, "the client's program and its arguments, one with {endpoint} in it")
        ->required();
    try
    {
        app.parse(argc, argv);
        if (!has_place_for_endpoint(options.command))
            throw CLI::ValidationError("client",
                                       "no argument has {endpoint} in it (the client must learn where the "
                                       "server is); write it where the endpoint belongs");
    }
    catch (CLI::ParseError const& error)
    {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try
    {
        return run(options, script);
    }
    catch (std::exception const& error)
    {
        std::fprintf(stderr, "gimdem-conformance: %s\n", error.what());
        return 1;
    }
}

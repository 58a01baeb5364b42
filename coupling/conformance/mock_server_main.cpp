// SPDX-License-Identifier: BSD-3-Clause
/// gimdem-mock-server: answers one client without particles, well or badly; docs/write-a-client.md.
///
/// Exit codes: 0 the session ended as the script says, 1 it did not, 2 wrong usage. What it found out about the client
/// goes to standard output, a line each: verdict, name and words with tabulators between them.
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "conformance/MockServer.hpp"

int main(int argc, char** argv)
{
    using namespace gimdem::conformance;
    using gimdem::coupling::Schedule;
    std::map<std::string, Schedule> const schedules{
        {"serial", Schedule::serial}, {"overlapped", Schedule::overlapped}, {"iterated", Schedule::iterated}};
    std::map<std::string, Misbehaviour> const misbehaviours{{"none", Misbehaviour::none},
                                                            {"refuse-mesh", Misbehaviour::refuse_mesh},
                                                            {"request-stop", Misbehaviour::request_stop},
                                                            {"delay", Misbehaviour::delay},
                                                            {"report-error", Misbehaviour::report_error},
                                                            {"die", Misbehaviour::die},
                                                            {"fall-silent", Misbehaviour::fall_silent},
                                                            {"wrong-version", Misbehaviour::wrong_version},
                                                            {"truncate", Misbehaviour::truncate}};

    Script script;
    CLI::App app("gimdem-mock-server: a server without particles, to try a client with");
    app.add_option("--endpoint", script.endpoint, "ipc:///path/of/socket, tcp://127.0.0.1:port or ...:*")->required();
    app.add_option("--keys", script.keys, "folder of keys, docs/security.md");
    app.add_option("--schedule", script.schedule, "told to the client")
        ->transform(CLI::CheckedTransformer(schedules, CLI::ignore_case));
    app.add_option("--until", script.end_time, "end time told to the client [s]");
    app.add_option("--needs", script.needs, "fluid fields to ask for (all five)");
    app.add_option("--void-fraction", script.law.void_fraction, "of every cell [1]")->check(CLI::Range(0.01, 1.0));
    app.add_option("--drag", script.law.drag, "coefficient K of the first cell [kg/(m^3 s)]");
    app.add_option("--momentum", script.law.momentum, "M of the first cell at the beginning [N/m^3]");
    app.add_option("--axis", script.law.axis, "direction of M (0 0 1)");
    app.add_option("--misbehave", script.misbehaviour, "what it does wrong, or asks for")
        ->transform(CLI::CheckedTransformer(misbehaviours, CLI::ignore_case));
    app.add_option("--at", script.at, "in the answer of which step (2)");
    app.add_option("--delay", script.delay, "of --misbehave delay [s]");
    app.add_option("--timeout", script.timeout, "a client silent for this long is dead [s]");
    app.add_option("--connect-time", script.connect_time, "how long to wait for a client [s]");
    try
    {
        app.parse(argc, argv);
    }
    catch (CLI::ParseError const& error)
    {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try
    {
        FindingsFile findings(stdout);
        return play(script, findings) ? 0 : 1;
    }
    catch (std::exception const& error)
    {
        std::fprintf(stderr, "gimdem-mock-server: %s\n", error.what());
        return 1;
    }
}

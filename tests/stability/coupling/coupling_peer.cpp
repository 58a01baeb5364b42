// SPDX-License-Identifier: BSD-3-Clause
/// One end of a session in a process of its own, to be killed, stopped and lied to.
///
/// Usage: coupling_peer server <endpoint> <time-out [s]> [<time for an answer [ms]> [<connect time [s]>]]
///        coupling_peer client <endpoint> <time-out [s]> <steps> [<time for a fluid step [ms]> [<connect time [s]>]]
/// Exit codes: 0 orderly end; 1 a fault, whose kind and text go to standard error; 2 wrong usage.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include "BoxMesh.hpp"
#include "SessionScript.hpp"

namespace
{

using namespace gimdem;

void pause(char const* milliseconds)
{
    if (milliseconds) std::this_thread::sleep_for(std::chrono::milliseconds(std::atoi(milliseconds)));
}

void serve(std::string const& endpoint, double timeout, char const* answer_time, char const* connect_time)
{
    coupling::ServerOptions options = test::storm_server(endpoint, timeout);
    if (connect_time) options.connect_time = std::atof(connect_time);
    coupling::Server server(options);
    std::cout << "bound to " << server.endpoint() << std::endl;
    test::serve(server, [&] { pause(answer_time); });
    std::cout << "goodbye: " << server.goodbye_reason() << std::endl;
}

void solve(std::string const& endpoint, double timeout, int steps, char const* step_time, char const* connect_time)
{
    coupling::ClientOptions options = test::storm_client(endpoint, timeout);
    if (connect_time) options.connect_time = std::atof(connect_time);
    coupling::Client client(options);
    test::solve(client, steps,
                [&](int step)
                {
                    pause(step_time);
                    if (step <= 3) std::cout << "step " << step << std::endl;
                });
    std::cout << "all steps done" << std::endl;
}

}  // namespace

int main(int argc, char** argv)
{
    std::string const role = argc > 3 ? argv[1] : "";
    try
    {
        if (role == "server")
            serve(argv[2], std::atof(argv[3]), argc > 4 ? argv[4] : nullptr, argc > 5 ? argv[5] : nullptr);
        else if (role == "client" && argc > 4)
            solve(argv[2], std::atof(argv[3]), std::atoi(argv[4]), argc > 5 ? argv[5] : nullptr,
                  argc > 6 ? argv[6] : nullptr);
        else
            return 2;
        return 0;
    }
    catch (coupling::CouplingError const& error)
    {
        std::cerr << "fault " << static_cast<int>(error.fault()) << ": " << error.what() << std::endl;
        return 1;
    }
}

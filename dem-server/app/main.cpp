// SPDX-License-Identifier: BSD-3-Clause
/// gimdem-server: reads a case, waits for a CFD client, moves the particles.
/// Exit codes: 0 the run ended as asked; 1 it could not; 2 wrong usage.
#include <csignal>
#include <exception>
#include <iostream>

#include "app/DemRun.hpp"
#include "app/Describe.hpp"
#include "app/Options.hpp"
#include "app/Run.hpp"

namespace
{

volatile std::sig_atomic_t interrupt_requested = 0;

extern "C" void on_interrupt(int)
{
    interrupt_requested = 1;
}

}  // namespace

bool gimdem::app::interrupted()
{
    return interrupt_requested != 0;
}

int main(int argc, char** argv)
{
    int exit_code = 0;
    auto const options = gimdem::app::parse_options(argc, argv, exit_code);
    if (!options) return exit_code;
    try
    {
        gimdem::Case const settings = gimdem::app::read_case_with(*options);
        if (options->describe)
        {
            std::cout << gimdem::app::describe(settings) << '\n';
            return 0;
        }
        std::signal(SIGINT, on_interrupt);
        std::signal(SIGTERM, on_interrupt);
        if (settings.run.client == "none")
            gimdem::app::run_alone(settings, options->run_folder, options->restart);
        else
            gimdem::app::run(settings, options->run_folder, options->restart);
        return 0;
    }
    catch (std::exception const& error)
    {
        std::cerr << "gimdem-server: " << error.what() << '\n';
        return 1;
    }
}

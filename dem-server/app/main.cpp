// SPDX-License-Identifier: BSD-3-Clause
/// gimdem-server: reads a case, waits for a CFD client, moves the particles.
/// Exit codes: 0 the run ended as asked; 1 it could not; 2 wrong usage.
#include <unistd.h>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "app/DemRun.hpp"
#include "app/Describe.hpp"
#include "app/Options.hpp"
#include "app/Run.hpp"
#include "app/StatusCommand.hpp"

namespace
{

volatile std::sig_atomic_t interrupt_requested = 0;

extern "C" void on_interrupt(int)
{
    interrupt_requested = 1;
}

/// Has threads that wait for each other sleep after some 50 microseconds, unless the environment says otherwise. By
/// default libgomp spins for longer than a scheduler's time slice: where the fluid solver wants the core, each of the
/// hundred parallel loops of a step waits for that slice, and on a core with two hardware threads the spinning one
/// slows the other. libgomp reads its environment before main(), hence the second start.
void start_with_short_waits(char** argv)
{
    if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
    ::setenv("GOMP_SPINCOUNT", "1000", 0);
    ::execv("/proc/self/exe", argv);  // if that fails, go on as we are
}

}  // namespace

void gimdem::app::heed_interrupts()
{
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
}

void gimdem::app::die_of_interrupts()
{
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool gimdem::app::interrupted()
{
    return interrupt_requested != 0;
}

int main(int argc, char** argv)
{
    start_with_short_waits(argv);
    std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is an error of writing, as a full disk is
    int exit_code = 0;
    auto const options = gimdem::app::parse_options(argc, argv, exit_code);
    if (!options) return exit_code;
    try
    {
        if (options->status)
        {
            gimdem::app::print_status(*options->status, options->patience, options->keys.value_or("").string(),
                                      options->json);
            return 0;
        }
        gimdem::Case const settings = gimdem::app::read_case_with(*options);
        if (options->describe)
        {
            std::cout << gimdem::app::describe(settings) << '\n';
            return 0;
        }
        if (settings.run.client == "none")
            gimdem::app::run_alone(settings, options->run_folder, options->restart);
        else
            gimdem::app::run(settings, options->run_folder, options->restart, options->trace);
        return 0;
    }
    catch (std::exception const& error)
    {
        std::cerr << "gimdem-server: " << error.what() << '\n';
        return 1;
    }
}

// SPDX-License-Identifier: BSD-3-Clause
/// coupling_storm: cycles, faults and a soak of the two ends of a session. Exit code 0: nothing went wrong.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "Storm.hpp"

int main(int argc, char** argv)
{
    std::setvbuf(stdout, nullptr, _IOLBF, 0);  // figures are seen as they come, also in a log
    int cycles = 0;
    int faults = 0;
    double soak = 0;
    unsigned seed = 1;
    CLI::App app("coupling_storm: what the two ends of a session survive");
    app.add_option("--cycles", cycles, "sessions one after the other")->check(CLI::NonNegativeNumber);
    app.add_option("--faults", faults, "random faults")->check(CLI::NonNegativeNumber);
    app.add_option("--soak", soak, "length of one session [s]")->check(CLI::NonNegativeNumber);
    app.add_option("--seed", seed, "of the random faults");
    CLI11_PARSE(app, argc, argv);

    int wrong = 0;
    if (cycles > 0) wrong += gimdem::test::run_cycles(cycles);
    if (faults > 0) wrong += gimdem::test::run_faults(faults, seed);
    if (soak > 0) wrong += gimdem::test::run_soak(soak);
    return wrong == 0 ? 0 : 1;
}

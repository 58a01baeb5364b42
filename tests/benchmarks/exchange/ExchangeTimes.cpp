// SPDX-License-Identifier: BSD-3-Clause
/// Round trips of the fields of a coupling step between two processes, beside ZeroMQ alone with as many bytes.
///
/// All ways are open at once and take turns, a few round trips each; medians are told. Rows to standard output:
/// way, transport, bytes, median and 10th and 90th percentile of gimdem [us], the same of ZeroMQ alone.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <exception>
#include <iostream>

#include "Exchange.hpp"

namespace gimdem::bench
{

namespace
{

using Clock = std::chrono::steady_clock;

struct Options
{
    std::array<int, 3> cells{33, 3, 181};  ///< grid A of cases/wachem-bed
    double occupied = 0.24;                ///< bed height of 0.12 m in a box of 0.5 m
    int rounds = 40;
    int turn = 5;      ///< round trips of a way in a round
    double pause = 0;  ///< between round trips [ms]: solvers compute then
};

std::vector<Way> all_ways()
{
    using coupling::Encodings;
    std::vector<Way> ways;
    for (auto const& [transport, shared] : {std::pair{"ipc", true}, std::pair{"ipc", false}, std::pair{"tcp", false}})
        for (auto const& [name, encodings] :
             {std::pair{"dense", Encodings{false, false, false}}, std::pair{"sparse", Encodings{true, false, false}},
              std::pair{"dense_float32", Encodings{false, true, false}},
              std::pair{"sparse_float32", Encodings{true, true, false}},
              std::pair{"dense_lz4", Encodings{false, false, true}},
              std::pair{"sparse_lz4", Encodings{true, false, true}}})
        {
            if (shared && encodings.lz4) continue;  // what lies in shared memory is not compressed
            std::string const where = shared ? "ipc_shared" : std::string(transport) + "_frames";
            ways.push_back({where + "_" + name, transport, shared, encodings});
        }
    return ways;
}

/// A way, and what its round trips took.
struct Measured
{
    Way way;
    std::unique_ptr<Exchange> coupled, bare;
    std::vector<double> coupled_us, bare_us;
};

void take(Exchange& exchange, Options const& options, std::vector<double>& times)
{
    for (int k = 0; k < options.turn; ++k)
    {
        for (auto const until = Clock::now() + std::chrono::duration<double, std::milli>(options.pause);
             Clock::now() < until;)
            ;
        auto const start = Clock::now();
        exchange.exchange();
        double const us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
        if (k > 0 || options.turn == 1)
            times.push_back(us);  // the first after a pause finds everything asleep and cold
    }
}

double percentile(std::vector<double> times, double share)
{
    auto const place = static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1) + 0.5);
    std::nth_element(times.begin(), times.begin() + place, times.end());
    return times[static_cast<std::size_t>(place)];
}

void run(Options const& options)
{
    Scene const scene(options.cells, options.occupied);
    std::vector<Measured> all;
    for (Way const& way : all_ways())
        all.push_back({way, coupled(way, scene), bare(way, scene), {}, {}});
    std::vector<double> warm_up;
    for (Measured& one : all)
        for (Exchange* const exchange : {one.coupled.get(), one.bare.get()})
            take(*exchange, options, warm_up);
    for (int round = 0; round < options.rounds; ++round)
        for (Measured& one : all)
        {
            take(*one.coupled, options, one.coupled_us);
            take(*one.bare, options, one.bare_us);
        }
    fmt::print("way,transport,bytes,bare_bytes,us,us_p10,us_p90,bare_us,bare_us_p10,bare_us_p90\n");
    for (Measured const& one : all)
        fmt::print("{},{},{:.0f},{:.0f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f}\n", one.way.name, one.way.transport,
                   one.coupled->bytes(), one.bare->bytes(), percentile(one.coupled_us, 0.5),
                   percentile(one.coupled_us, 0.1), percentile(one.coupled_us, 0.9), percentile(one.bare_us, 0.5),
                   percentile(one.bare_us, 0.1), percentile(one.bare_us, 0.9));
}

}  // namespace

}  // namespace gimdem::bench

int main(int argc, char** argv)
{
    gimdem::bench::Options options;
    CLI::App app("round trips of the fields of a coupling step, beside ZeroMQ alone");
    app.add_option("--cells", options.cells, "in x, y, z");
    app.add_option("--occupied", options.occupied, "share of the layers in z that hold particles");
    app.add_option("--rounds", options.rounds, "turns of each way")->check(CLI::PositiveNumber);
    app.add_option("--turn", options.turn, "round trips in a turn")->check(CLI::PositiveNumber);
    app.add_option("--pause", options.pause, "computed before each round trip [ms]");
    CLI11_PARSE(app, argc, argv);
    try
    {
        gimdem::bench::run(options);
        return 0;
    }
    catch (std::exception const& error)
    {
        std::cerr << "exchange_times: " << error.what() << '\n';
        return 1;
    }
}

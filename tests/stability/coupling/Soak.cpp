// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include "Endpoint.hpp"
#include "Figure.hpp"
#include "Process.hpp"
#include "ProcessMeters.hpp"
#include "SessionScript.hpp"
#include "Storm.hpp"
#include "TemporaryFolder.hpp"

namespace gimdem::test
{
namespace
{

double constexpr timeout = 30;
double constexpr steps_per_second = 100;
/// As long as one step's 10 ms may take on a machine that does other things, many times over.
double constexpr slowness = 100;
/// A page for an arena or a log now and then; a frame kept each second would be 8 KiB of them [byte/s].
double constexpr most_growth = 1024;

struct Meters
{
    double memory = 0;
    double descriptors = 0;
};

Meters look_at(Process const& process)
{
    return {own_memory(process.id()), file_descriptors(process.id())};
}

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int run_soak(double seconds)
{
    TemporaryFolder const folder;
    std::string const endpoint = unused_ipc_endpoint();
    auto const steps = static_cast<long>(seconds * steps_per_second);
    Process server({GIMDEM_COUPLING_PEER, "server", endpoint, std::to_string(timeout)}, folder / "server.txt");
    Process client({GIMDEM_COUPLING_PEER, "client", endpoint, std::to_string(timeout), std::to_string(steps), "10"},
                   folder / "client.txt");
    auto const start = std::chrono::steady_clock::now();
    std::array<Process*, 2> const both{&server, &client};
    std::array<Meters, 2> first;
    std::array<Meters, 2> last;
    double first_at = 0;
    double last_at = 0;
    while (!client.wait(seconds / 50) && seconds_since(start) < appears_in + slowness * seconds)
    {
        double const now = seconds_since(start);
        bool const early = now < seconds / 4;  // threads and pools get their size
        for (std::size_t k = 0; k < both.size(); ++k)
            (early ? first : last)[k] = look_at(*both[k]);
        (early ? first_at : last_at) = now;
    }

    int wrong = 0;
    figure("soak_time", seconds_since(start), "s");
    figure("soak_steps", static_cast<double>(steps));
    for (std::size_t k = 0; k < both.size(); ++k)
    {
        std::string const who = k == 0 ? "server" : "client";
        double const growth = (last[k].memory - first[k].memory) / (last_at - first_at);
        double const more = last[k].descriptors - first[k].descriptors;
        figure("soak_memory_growth_of_" + who, growth, "byte/s");
        figure("soak_file_descriptors_growth_of_" + who, more);
        bool const ended = both[k]->wait(timeout) == 0;
        if (!ended) fmt::print("wrong: the {} of the soak: {}\n", who, both[k]->output()), ++wrong;
        bool const flat = growth < most_growth || last[k].memory - first[k].memory < 256 << 10;
        if (!flat || more > 0) fmt::print("wrong: the {} of the soak grows\n", who), ++wrong;
    }
    return wrong;
}

}  // namespace gimdem::test

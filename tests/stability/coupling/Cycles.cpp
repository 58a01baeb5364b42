// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <malloc.h>

#include <filesystem>
#include <string>
#include <thread>

#include "Endpoint.hpp"
#include "Figure.hpp"
#include "ProcessMeters.hpp"
#include "SessionScript.hpp"
#include "SharedMemoryNames.hpp"
#include "Storm.hpp"

namespace gimdem::test
{
namespace
{

int constexpr steps = 3;
double constexpr timeout = 30;
/// Until threads, pools and arenas have the size that they keep.
int constexpr warm_up = 20;
/// Growth of a cycle, and what arenas and stacks of threads come and go by however many cycles there are: up to 270 KB
/// either way were seen [byte]. A session's smallest frame of a field has 8 KiB, its mesh 200: whoever kept one a cycle
/// would be above both together from 60 cycles on.
double constexpr most_growth = 1024;
double constexpr wobble = 400 * 1024;

/// Returns what is wrong.
std::string run_cycle(std::string const& given)
{
    std::string fault;
    {
        coupling::Server server(storm_server(given, timeout));
        std::thread other(
            [&]
            {
                try
                {
                    coupling::Client client(storm_client(server.endpoint(), timeout));
                    solve(client, steps);
                }
                catch (coupling::CouplingError const& error)
                {
                    fault = error.what();
                }
            });
        try
        {
            serve(server);
        }
        catch (coupling::CouplingError const& error)
        {
            fault = error.what();
        }
        other.join();
    }
    bool const left_file = given.rfind("ipc", 0) == 0 && (std::filesystem::exists(file_of(given)) ||
                                                          std::filesystem::exists(file_of(given) + ".lock"));
    if (left_file) return "a socket file is left";
    if (!shared_memory_names().empty()) return "shared memory is left";
    return fault;
}

}  // namespace

int run_cycles(int count)
{
    int wrong = 0;
    double memory = 0;
    double descriptors = 0;
    for (int cycle = 1; cycle <= warm_up + count; ++cycle)
    {
        std::string const problem = run_cycle(cycle % 2 == 0 ? unused_ipc_endpoint() : any_tcp_endpoint());
        if (!problem.empty()) fmt::print("wrong: cycle {}: {}\n", cycle, problem), ++wrong;
        if (cycle != warm_up) continue;
        ::malloc_trim(0);
        memory = own_memory();
        descriptors = file_descriptors();
    }
    ::malloc_trim(0);
    double const grown = own_memory() - memory;
    double const more = file_descriptors() - descriptors;
    figure("start_stop_cycles", count);
    figure("memory_growth_per_cycle", grown / count, "byte");
    figure("file_descriptors_growth", more);
    if (grown > most_growth * count + wobble)
        fmt::print("wrong: memory has grown by {:.0f} bytes in {} cycles\n", grown, count), ++wrong;
    if (more != 0) fmt::print("wrong: {:.0f} more file descriptors than before\n", more), ++wrong;
    return wrong;
}

}  // namespace gimdem::test

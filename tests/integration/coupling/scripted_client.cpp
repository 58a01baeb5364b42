// SPDX-License-Identifier: BSD-3-Clause
/// A client in a process of its own, to be killed and stopped; or one rank of several.
///
/// Usage: scripted_client <endpoint> <time-out [s]> <steps> [<folder of keys, or ""> [<steps between checkpoints>
///                        [<rank> <ranks>]]]
/// Exit codes: 0 orderly end, 1 a fault, whose text goes to standard error, 2 wrong usage.
#include <cstdlib>
#include <iostream>
#include <string>

#include "ScriptedMesh.hpp"
#include "UniformFluid.hpp"
#include "gimdem/coupling/Client.hpp"

namespace
{

using namespace gimdem;

void run(std::string const& endpoint, double timeout, int steps, std::string const& keys, int steps_between_checkpoints,
         coupling::Rank const& rank)
{
    double constexpr dt = 1e-4;  // [s]
    coupling::ClientOptions options;
    options.endpoint = endpoint;
    options.name = "scripted client";
    options.timeout = timeout;
    options.keys = keys;
    options.rank = rank;
    coupling::Client client(options);
    for (std::string const& next : client.connect(test::air).rank_endpoints)
        std::cout << "the next rank at " << next << std::endl;
    coupling::Mesh const mesh = test::part_of_scripted_mesh(rank);
    client.send_mesh(test::view_of(mesh));

    test::UniformFluid const fluid(static_cast<std::size_t>(mesh.cell_count), {0, 0, 1});
    std::int64_t complete_step = 0;
    for (int n = 1; n <= steps; ++n)
    {
        client.begin_step({n, dt * (n - 1), dt}, fluid.view());
        client.end_step();
        std::cout << "step " << n << std::endl;
        if (rank.number > 0 || steps_between_checkpoints == 0 || n % steps_between_checkpoints != 0) continue;
        coupling::SavedCheckpoint const saved = client.save_checkpoint(dt * (n - 1) + dt, complete_step);
        complete_step = saved.step;
        std::cout << "saved step " << saved.step << " of session " << saved.session << std::endl;
    }
    client.finish("all steps done");
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc < 4 || argc > 8 || argc == 7) return 2;
    try
    {
        coupling::Rank const rank =
            argc == 8 ? coupling::Rank{std::atoi(argv[6]), std::atoi(argv[7]), test::run_number} : coupling::Rank{};
        run(argv[1], std::atof(argv[2]), std::atoi(argv[3]), argc > 4 ? argv[4] : "", argc > 5 ? std::atoi(argv[5]) : 0,
            rank);
        return 0;
    }
    catch (std::exception const& error)
    {
        std::cerr << "scripted client: " << error.what() << std::endl;
        return 1;
    }
}

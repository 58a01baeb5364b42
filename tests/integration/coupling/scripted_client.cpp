// SPDX-License-Identifier: BSD-3-Clause
/// A client in a process of its own, to be killed and stopped.
///
/// Usage: scripted_client <endpoint> <time-out [s]> <steps> [<folder of keys, or ""> [<steps between checkpoints>]]
/// Exit codes: 0 orderly end, 1 a fault, whose text goes to standard error, 2 wrong usage.
#include <cstdlib>
#include <iostream>
#include <string>

#include "BoxMesh.hpp"
#include "UniformFluid.hpp"
#include "gimdem/coupling/Client.hpp"

namespace
{

void run(std::string const& endpoint, double timeout, int steps, std::string const& keys, int steps_between_checkpoints)
{
    using namespace gimdem;
    double constexpr dt = 1e-4;  // [s]
    coupling::ClientOptions options;
    options.endpoint = endpoint;
    options.name = "scripted client";
    options.timeout = timeout;
    options.keys = keys;
    coupling::Client client(options);
    client.connect(test::air);
    // 1024 cells: vector fields are large enough for shared memory.
    coupling::Mesh const mesh = test::BoxMesh::make({8, 8, 16}, {0.06, 0.06, 0.12});
    client.send_mesh(test::view_of(mesh));

    test::UniformFluid const fluid(static_cast<std::size_t>(mesh.cell_count), {0, 0, 1});
    std::int64_t complete_step = 0;
    for (int n = 1; n <= steps; ++n)
    {
        client.begin_step({n, dt * (n - 1), dt}, fluid.view());
        client.end_step();
        std::cout << "step " << n << std::endl;
        if (steps_between_checkpoints == 0 || n % steps_between_checkpoints != 0) continue;
        coupling::SavedCheckpoint const saved = client.save_checkpoint(dt * (n - 1) + dt, complete_step);
        complete_step = saved.step;
        std::cout << "saved step " << saved.step << " of session " << saved.session << std::endl;
    }
    client.finish("all steps done");
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc < 4 || argc > 6) return 2;
    try
    {
        run(argv[1], std::atof(argv[2]), std::atoi(argv[3]), argc > 4 ? argv[4] : "",
            argc > 5 ? std::atoi(argv[5]) : 0);
        return 0;
    }
    catch (std::exception const& error)
    {
        std::cerr << "scripted client: " << error.what() << std::endl;
        return 1;
    }
}

// SPDX-License-Identifier: BSD-3-Clause
/// Both ends of a small session: 1024 cells, fields large enough for shared memory.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "BoxMesh.hpp"
#include "UniformFluid.hpp"
#include "gimdem/coupling/Client.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::test
{

inline constexpr double appears_in = 20;  ///< for a process to start on a busy machine [s]

inline coupling::ServerOptions storm_server(std::string const& endpoint, double timeout)
{
    coupling::ServerOptions options;
    options.endpoint = endpoint;
    options.name = "storm server";
    options.timeout = timeout;
    options.connect_time = appears_in;
    options.step_time = appears_in;
    return options;
}

inline coupling::ClientOptions storm_client(std::string const& endpoint, double timeout)
{
    coupling::ClientOptions options;
    options.endpoint = endpoint;
    options.name = "storm client";
    options.timeout = timeout;
    options.connect_time = appears_in;
    options.step_time = appears_in;
    return options;
}

/// Answers every fluid until Goodbye. before_answer: the work of the particles.
inline void serve(coupling::Server& server, std::function<void()> const& before_answer = {})
{
    coupling::ServerTerms terms;
    terms.title = "a storm";
    terms.end_time = 1;
    terms.needs = {coupling::field::velocity};
    server.wait_for_client(terms);
    auto const cells = static_cast<std::size_t>(server.receive_mesh().cell_count);
    std::vector<double> const ones(3 * cells, 1.0);
    coupling::SolidFields fields;
    fields.void_fraction = {ones.data(), cells};
    fields.drag_coefficient = {ones.data(), cells};
    fields.drag_momentum = {ones.data(), 3 * cells};
    server.accept_mesh(fields);
    while (server.receive_fluid())
    {
        if (before_answer) before_answer();
        server.send_solid(fields, {});
    }
}

/// So many steps and Goodbye. in_step: the work of the fluid.
inline void solve(coupling::Client& client, int steps, std::function<void(int)> const& in_step = {})
{
    double constexpr dt = 1e-4;  // [s]
    client.connect(air);
    coupling::Mesh const mesh = BoxMesh::make({8, 8, 16}, {0.06, 0.06, 0.12});
    client.send_mesh(view_of(mesh));
    UniformFluid const fluid(static_cast<std::size_t>(mesh.cell_count), {0, 0, 1});
    for (int n = 1; n <= steps; ++n)
    {
        client.begin_step({n, dt * (n - 1), dt}, fluid.view());
        if (in_step) in_step(n);
        client.end_step();
    }
    client.finish("all steps done");
}

}  // namespace gimdem::test

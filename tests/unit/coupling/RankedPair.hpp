// SPDX-License-Identifier: BSD-3-Clause
/// A server and a client of several ranks, each in a thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <future>
#include <string>
#include <vector>

#include "Faults.hpp"
#include "MeshParts.hpp"
#include "Pair.hpp"

namespace gimdem::test
{

inline constexpr std::uint64_t run_number = 4711;

inline coupling::ClientOptions rank_options(std::string const& endpoint, int rank, int ranks)
{
    coupling::ClientOptions options = client_options(endpoint);
    options.rank = {rank, ranks, run_number};
    return options;
}

/// A mesh in slices, and what each rank knows of the endpoints.
class RankedClient
{
public:
    RankedClient(std::string const& endpoint, int ranks)
        : RankedClient(rank_options(endpoint, 0, ranks), cut(small_mesh(), dealt(small_mesh().cell_count, ranks, 2)))
    {
    }
    RankedClient(coupling::ClientOptions const& first, MeshParts mesh) : pieces(std::move(mesh))
    {
        clients.reserve(pieces.parts.size());
        clients.emplace_back(first);
    }

    std::size_t count() const { return pieces.parts.size(); }
    std::size_t cells(std::size_t rank) const { return pieces.cells[rank].size(); }

    /// Rank 0 greets, and the others' clients are made with what it is told. change: of their options.
    void connect_first(std::function<void(coupling::ClientOptions&)> const& change = {})
    {
        auto const told = clients[0].connect({1.2, 1.8e-5}).rank_endpoints;
        for (std::size_t rank = 1; rank < count(); ++rank)
        {
            auto options = rank_options(told.at(rank - 1), static_cast<int>(rank), static_cast<int>(count()));
            if (change) change(options);
            clients.emplace_back(options);
        }
    }

    /// Runs body(rank) for all ranks at once; returns what each threw.
    std::vector<std::string> on_all(std::function<void(std::size_t)> const& body)
    {
        std::vector<std::future<std::string>> results;
        for (std::size_t rank = 0; rank < count(); ++rank)
            results.push_back(in_background([&body, rank] { return thrown_by([&] { body(rank); }); }));
        std::vector<std::string> words;
        for (auto& result : results)
            words.push_back(result.get());
        return words;
    }

    void begin(std::size_t rank)
    {
        if (rank > 0) clients[rank].connect({1.2, 1.8e-5});
        clients[rank].send_mesh(view_of(pieces.parts[rank]));
    }

    /// Step n with the fluid FluidArrays(cells, 100 rank + n).
    coupling::SolidFields const& step_of(std::size_t rank, int n)
    {
        auto const& solid =
            clients[rank].begin_step(step(n), FluidArrays(cells(rank), 100.0 * static_cast<double>(rank) + n).view(),
                                     {{"courant_max", static_cast<double>(rank), "1"}});
        return solid;
    }

    MeshParts pieces;
    std::vector<coupling::Client> clients;
};

/// Serves until the end, as EndingTest does; returns what ended it.
inline std::string serve_ranks(coupling::Server& server, coupling::Schedule schedule = coupling::Schedule::serial)
{
    return thrown_by(
        [&]
        {
            server.wait_for_client(server_terms(schedule));
            auto const cells = static_cast<std::size_t>(server.receive_mesh().cell_count);
            server.accept_mesh(SolidArrays(cells, 0).view());
            while (auto fluid = server.receive_fluid())
                server.send_solid(SolidArrays(cells, static_cast<double>(fluid->step.number)).view(), {});
        });
}

}  // namespace gimdem::test

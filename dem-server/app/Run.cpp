// SPDX-License-Identifier: BSD-3-Clause
#include "app/Run.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <utility>

#include "app/CoupledRun.hpp"
#include "app/Reception.hpp"
#include "core/Error.hpp"
#include "engine/StartChecks.hpp"
#include "engine/WallStartCheck.hpp"
#include "particles/Insertion.hpp"

namespace gimdem::app
{

namespace
{

/// A mistake in the case is told before a client is waited for.
ParticleState checked_particles(Case const& settings, Materials const& materials)
{
    refuse_periodic_coupled_run(settings);
    ParticleState particles = insert_particles(settings, materials);
    check_time_step(settings, materials, particles);
    check_overlaps(exec::make_execution(settings.dem.backend, settings.dem.threads), particles,
                   Domain::of(settings.domain));
    check_particles_against_walls(particles, WallGeometry(settings.wall, reach_of(settings, particles)));
    return particles;
}

void require_checkpoint_for(coupling::ClientInfo const& client, bool has_checkpoint)
{
    if (!client.resume || has_checkpoint) return;
    throw UserError(
        fmt::format("{} goes on at {:.9g} s from the checkpoint of step {} (this server begins a run); "
                    "start the server with --restart and that checkpoint",
                    client.name, client.resume->time, client.resume->step));
}

/// Steps until the client says goodbye; one that is lost without a word may come back.
void couple(Reception& reception, CoupledRun& run, double grace_time)
{
    while (true)
    {
        try
        {
            return run.couple(reception.server());
        }
        catch (coupling::CouplingError const& error)
        {
            if (grace_time == 0 || !reception.server().has_lost_client()) throw;
            fmt::print(stderr, "gimdem-server: {}; waiting {:g} s for a client that goes on\n", error.what(),
                       grace_time);
            die_of_interrupts();
            bool const is_back = reception.meet_again(run, grace_time);
            heed_interrupts();
            if (!is_back) throw;
        }
    }
}

}  // namespace

void run(Case const& settings, std::filesystem::path const& folder, std::optional<std::filesystem::path> const& restart,
         double grace_time)
{
    std::filesystem::create_directories(folder);
    Materials const materials(settings);
    ParticleState particles = checked_particles(settings, materials);
    std::unique_ptr<CoupledRun> coupled;
    Reception reception(settings, [&](auto const& request) { return coupled->save(request); });
    fmt::print(stderr, "gimdem-server: {} particles, waiting for a client at {}\n", particles.count(),
               reception.server().endpoint());
    try
    {
        coupling::ClientInfo const client = reception.meet();
        heed_interrupts();
        fmt::print(stderr, "gimdem-server: {} connected\n", client.name);
        require_checkpoint_for(client, restart.has_value());
        coupled =
            std::make_unique<CoupledRun>(settings, folder, reception.server(), client, std::move(particles), materials);
        coupled->start(reception.server(), restart);
        try
        {
            couple(reception, *coupled, grace_time);
        }
        catch (...)
        {
            coupled->finish_after_failure(reception.server());
            throw;
        }
        coupled->finish(reception.server());
    }
    catch (UserError const& error)
    {
        reception.server().abort(error.what());
        throw;
    }
}

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
#include "app/Run.hpp"

#include <fmt/format.h>

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
            return run.couple();
        }
        catch (coupling::CouplingError const& error)
        {
            if (grace_time == 0 || !reception.server().has_lost_client()) throw;
            die_of_interrupts();
            bool const is_back = reception.meet_again(run, grace_time, error.what());
            heed_interrupts();
            if (!is_back) throw;
        }
    }
}

/// All with the first client.
void serve(Reception& reception, CoupledRun& run, std::optional<std::filesystem::path> const& restart,
           double grace_time)
{
    run.start(restart);
    try
    {
        couple(reception, run, grace_time);
    }
    catch (...)
    {
        run.finish_after_failure();
        throw;
    }
    run.finish();
}

}  // namespace

void run(Case const& settings, std::filesystem::path const& folder, std::optional<std::filesystem::path> const& restart,
         output::TraceChoice const& trace)
{
    refuse_periodic_coupled_run(settings);
    std::filesystem::create_directories(folder);
    RunEvents events(folder);
    Materials const materials(settings);
    ParticleState particles = checked_particles(settings, materials);
    std::unique_ptr<CoupledRun> coupled;
    Reception reception(settings, folder, events, [&](auto const& request) { return coupled->save(request); });
    events.say(
        "listening",
        fmt::format("{} particles, waiting for a client at {}", particles.count(), reception.server().endpoint()),
        {{"version", GIMDEM_VERSION}, {"case", settings.title}, {"endpoint", reception.server().endpoint()}});
    try
    {
        coupling::ClientInfo const client = reception.meet();
        heed_interrupts();
        events.say("client_connected", client.name + " connected", {{"client", client.name}});
        require_checkpoint_for(client, restart.has_value());
        coupled = std::make_unique<CoupledRun>(settings, folder, reception.server(), client, std::move(particles),
                                               materials, events, trace);
        serve(reception, *coupled, restart, settings.coupling.grace_time);
        events.note("finished", reception.server().goodbye_reason());
    }
    catch (UserError const& error)
    {
        reception.server().abort(error.what());
        events.fail(error.what());
        throw;
    }
    catch (std::exception const& error)
    {
        events.fail(error.what());
        throw;
    }
}

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
#include "app/Run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "app/RunLog.hpp"
#include "core/Error.hpp"
#include "engine/CoupledEngine.hpp"
#include "engine/Settling.hpp"
#include "engine/StartChecks.hpp"
#include "gimdem/coupling/Server.hpp"
#include "particles/Insertion.hpp"

namespace gimdem::app
{

namespace
{

namespace field = coupling::field;

/// The fluid fields that this scene needs, and no other.
std::vector<std::string> needed_fields(Case const& settings)
{
    std::vector<std::string> needs;
    if (settings.fluid_forces.drag != "none")
        needs = {field::velocity, field::velocity_gradient, field::void_fraction_gradient};
    if (settings.fluid_forces.pressure_gradient) needs.emplace_back(field::pressure_gradient);
    OutputSettings const& output = settings.output;
    if (!output.planes.empty() || !output.inlet.empty() || output.particle_interval > 0)
        needs.emplace_back(field::pressure);
    return needs;
}

coupling::ServerTerms terms_of(Case const& settings)
{
    return {.title = settings.title,
            .schedule = settings.coupling.schedule == "overlapped" ? coupling::Schedule::overlapped
                                                                   : coupling::Schedule::serial,
            .end_time = settings.run.until,
            .needs = needed_fields(settings)};
}

/// With both solvers at work at once, one core is the client's.
exec::Execution execution_for(Case const& settings, coupling::Schedule schedule)
{
    int threads = settings.dem.threads;
    if (threads == 0 && schedule == coupling::Schedule::overlapped) threads = std::max(1, exec::processor_count() - 1);
    return exec::make_execution(settings.dem.backend, threads, settings.dem.sorting);
}

PolyMesh take_mesh(coupling::Server& server)
{
    coupling::Mesh topology = server.receive_mesh();
    try
    {
        return PolyMesh(std::move(topology));
    }
    catch (UserError const& error)
    {
        server.reject_mesh(error.what());
        throw;
    }
}

/// Puts the settled bed into the system: from the file where it was settled before, else by settling now.
void settle_or_load(Case const& settings, exec::Execution execution, WallGeometry const& walls, PolyMesh const& mesh,
                    DemSystem& system, output::Progress& progress)
{
    system.prepare();
    if (!settings.settle || settings.settle->duration <= 0) return;
    auto const file = settled_bed_file(settings, walls, mesh);
    if (!std::filesystem::exists(file))
    {
        double const time = settle(settings, execution, system,
                                   [&](double at, double energy)
                                   {
                                       progress.show(output::SettlingSample{at, settings.settle->duration, energy,
                                                                            settings.settle->kinetic_energy});
                                       return !interrupted();
                                   });
        progress.finish();
        write_state(file, "settled bed", system, time);
    }
    // Always by way of the file, so that a bed just settled and one kept give the same run to the bit.
    read_state(file, "settled bed", system);
}

/// Everything after the mesh.
class CoupledRun
{
public:
    CoupledRun(Case const& settings, std::filesystem::path const& folder, coupling::Server& server,
               coupling::ClientInfo const& client, ParticleState particles, Materials const& materials)
        : settings_(settings),
          server_(server),
          schedule_(client.schedule.value_or(terms_of(settings).schedule)),
          execution_(execution_for(settings, schedule_)),
          mesh_(take_mesh(server)),
          walls_(mesh_, settings.walls.also, largest_radius(particles) + settings.dem.skin * smallest_radius(particles),
                 settings.wall),
          system_(settings, execution_, materials, walls_, std::move(particles)),
          folder_(folder),
          log_(settings, folder, mesh_, system_, client, schedule_),
          engine_(settings, execution_, mesh_, walls_, client.fluid, system_)
    {
    }

    void start()
    {
        settle_or_load(settings_, execution_, walls_, mesh_, system_, log_.progress());
        Vec3 const up = upward(settings_);
        log_.summary().add("settled_height", bed_height(system_.particles(), mesh_, up), "m");
        log_.summary().add("settled_height_2z", 2 * centre_of_mass_height(system_.particles(), mesh_, up), "m");
        engine_.map_initial_state();
        server_.accept_mesh(engine_.fields());
        if (!server_.shared_memory_note().empty())
            fmt::print(stderr, "gimdem-server: note: {}\n", server_.shared_memory_note());
    }

    void couple()
    {
        while (auto const fluid = server_.receive_fluid())
        {
            double const output_time = log_.sample(*fluid, engine_);
            StepReport report = engine_.advance(fluid->step, fluid->fields);
            report.timings.output = output_time;
            if (interrupted()) server_.request_stop("interrupted by the user");
            server_.send_solid(engine_.fields(), report.timings);
            log_.record(*fluid, report, engine_);
            time_ = fluid->step.time + fluid->step.dt;
        }
    }

    /// Figures and the last state of the particles, whatever ended the run.
    void finish()
    {
        log_.finish(server_.bytes());
        write_state(folder_ / "particles_last.h5", "particles", system_, time_);
    }

private:
    Case const& settings_;
    coupling::Server& server_;
    coupling::Schedule schedule_;
    exec::Execution execution_;
    PolyMesh mesh_;
    WallGeometry walls_;
    DemSystem system_;
    std::filesystem::path folder_;
    RunLog log_;
    CoupledEngine engine_;
    double time_ = 0;
};

}  // namespace

void run(Case const& settings, std::filesystem::path const& folder)
{
    refuse_periodic_coupled_run(settings);
    std::filesystem::create_directories(folder);
    Materials const materials(settings);
    ParticleState particles = insert_particles(settings, materials);
    check_time_step(settings, materials, particles);
    check_overlaps(exec::make_execution(settings.dem.backend, settings.dem.threads), particles,
                   Domain::of(settings.domain));

    coupling::Server server({.endpoint = settings.coupling.endpoint,
                             .name = "gimdem-server " GIMDEM_VERSION,
                             .timeout = settings.coupling.timeout,
                             .connect_time = settings.coupling.connect_time});
    fmt::print(stderr, "gimdem-server: {} particles, waiting for a client at {}\n", particles.count(),
               server.endpoint());
    try
    {
        coupling::ClientInfo const client = server.wait_for_client(terms_of(settings));
        fmt::print(stderr, "gimdem-server: {} connected\n", client.name);
        CoupledRun coupled(settings, folder, server, client, std::move(particles), materials);
        coupled.start();
        try
        {
            coupled.couple();
        }
        catch (...)
        {
            coupled.finish();
            throw;
        }
        coupled.finish();
    }
    catch (UserError const& error)
    {
        server.abort(error.what());
        throw;
    }
}

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
#include "app/Run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "app/ExchangeLog.hpp"
#include "app/RunLog.hpp"
#include "core/Error.hpp"
#include "engine/CellSizeCheck.hpp"
#include "engine/Checkpoint.hpp"
#include "engine/CoupledEngine.hpp"
#include "engine/InletFlow.hpp"
#include "engine/Settling.hpp"
#include "engine/StartChecks.hpp"
#include "engine/WallStartCheck.hpp"
#include "engine/WallStepCheck.hpp"
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
          walls_(mesh_, settings.walls.also, reach_of(settings, particles), settings.wall),
          inlets_(make_inlets(settings, materials)),
          system_(settings, execution_, materials, walls_, std::move(particles)),
          folder_(folder),
          log_(settings, folder, mesh_, system_, client, schedule_),
          exchange_log_(folder, settings.output.sample_interval),
          engine_(settings, execution_, mesh_, walls_, client.fluid, system_)
    {
    }

    void start(std::optional<std::filesystem::path> const& restart)
    {
        std::string const note = note_on_small_cells(mesh_, reach_of(settings_, std::as_const(system_).particles()));
        if (!note.empty()) fmt::print(stderr, "gimdem-server: note: {}\n", note);
        if (restart)
        {
            system_.prepare();
            start_ = at_ = read_checkpoint(*restart, settings_, inlets_, system_, engine_.weight_reuse());
            require_time_left(*restart, at_, settings_.run.until);
            fmt::print(stderr, "gimdem-server: {} particles from {:.6g} s\n", system_.particles().count(), at_.time);
        }
        else
            settle();
        engine_.set_inlets(inlets_);
        engine_.map_initial_state();
        engine_.monitor(log_.monitored_cells());
        server_.accept_mesh(engine_.fields(), {}, cells_to_send(at_.time));
        if (!server_.shared_memory_note().empty())
            fmt::print(stderr, "gimdem-server: note: {}\n", server_.shared_memory_note());
    }

    void couple()
    {
        while (auto fluid = server_.receive_fluid())
        {
            if (at_.step == start_.step) check_start(fluid->step);
            exchange_log_.record(*fluid, server_.bytes());
            double const output_time = log_.sample(*fluid, engine_);
            StepReport report = engine_.advance(fluid->step, fluid->fields, whole(*fluid));
            report.timings.output = output_time;
            if (interrupted()) server_.request_stop("interrupted by the user");
            server_.send_solid(engine_.fields(), report.timings, cells_to_send(fluid->step.time + fluid->step.dt));
            log_.record(*fluid, report, engine_);
            double const before = at_.time;
            at_ = {at_.step + 1, fluid->step.time + fluid->step.dt};
            if (is_checkpoint_between(before, at_.time)) keep();
        }
    }

    /// Figures and the last state of the particles, whatever ended the run.
    void finish()
    {
        log_.finish(server_.bytes());
        keep();
    }

private:
    /// In serial runs the client, which waits, can be asked for the cells that it left out.
    std::function<coupling::FluidFields()> whole(coupling::FluidState& fluid)
    {
        if (fluid.is_complete) return {};
        return [this, &fluid]
        {
            server_.complete(fluid);
            return fluid.fields;
        };
    }

    /// For the solid of a step that ends at `time` [s], and the fluid of the next one.
    coupling::StepCells cells_to_send(double time)
    {
        coupling::StepCells cells = engine_.step_cells(schedule_ == coupling::Schedule::serial);
        if (log_.expects_frame(time)) cells.needed.clear();
        return cells;
    }

    void settle()
    {
        check_particles_against_walls(system_.particles(), walls_);
        check_wall_steps(settings_, walls_, mesh_, smallest_radius(settings_, std::as_const(system_).particles()));
        settle_or_load(settings_, execution_, walls_, mesh_, system_, log_.progress());
        Vec3 const up = upward(settings_);
        log_.summary().add("settled_height", bed_height(system_.particles(), mesh_, up), "m");
        log_.summary().add("settled_height_2z", 2 * centre_of_mass_height(system_.particles(), mesh_, up), "m");
    }

    /// The fluid of a restarted run must begin where the particles are. A wrong pair is off by a step at least; names
    /// of time folders are off by rounding.
    void check_start(coupling::Step const& first) const
    {
        if (start_.step == 0 || std::abs(first.time - start_.time) < 0.1 * first.dt) return;
        throw UserError(
            fmt::format("the fluid begins at {:.9g} s, the checkpoint of the particles is at {:.9g} s (they must be of "
                        "one time); start the client from its fields at {:.9g} s",
                        first.time, start_.time, start_.time));
    }

    bool is_checkpoint_between(double before, double now) const
    {
        double const interval = settings_.output.checkpoint_interval;
        auto const count = [=](double time) { return std::floor(time / interval + 1e-6); };
        return interval > 0 && count(now) > count(before);
    }

    void keep()
    {
        write_checkpoint(checkpoint_file(folder_, at_), settings_, at_, inlets_, system_, engine_.weight_reuse());
        keep_newest_checkpoints(folder_);
    }

    Case const& settings_;
    coupling::Server& server_;
    coupling::Schedule schedule_;
    exec::Execution execution_;
    PolyMesh mesh_;
    WallGeometry walls_;
    std::vector<Inlet> inlets_;
    DemSystem system_;
    std::filesystem::path folder_;
    RunLog log_;
    ExchangeLog exchange_log_;
    CoupledEngine engine_;
    RunPoint start_, at_;  ///< in coupling steps
};

}  // namespace

void run(Case const& settings, std::filesystem::path const& folder, std::optional<std::filesystem::path> const& restart)
{
    refuse_periodic_coupled_run(settings);
    std::filesystem::create_directories(folder);
    Materials const materials(settings);
    ParticleState particles = insert_particles(settings, materials);
    check_time_step(settings, materials, particles);
    check_overlaps(exec::make_execution(settings.dem.backend, settings.dem.threads), particles,
                   Domain::of(settings.domain));
    // A mistake in the file of a wall is told before a client is waited for.
    check_particles_against_walls(particles, WallGeometry(settings.wall, reach_of(settings, particles)));

    coupling::Server server({.endpoint = settings.coupling.endpoint,
                             .name = "gimdem-server " GIMDEM_VERSION,
                             .timeout = settings.coupling.timeout,
                             .connect_time = settings.coupling.connect_time});
    fmt::print(stderr, "gimdem-server: {} particles, waiting for a client at {}\n", particles.count(),
               server.endpoint());
    try
    {
        coupling::ClientInfo const client = server.wait_for_client(terms_of(settings));
        heed_interrupts();
        fmt::print(stderr, "gimdem-server: {} connected\n", client.name);
        CoupledRun coupled(settings, folder, server, client, std::move(particles), materials);
        coupled.start(restart);
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

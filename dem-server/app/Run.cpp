// SPDX-License-Identifier: BSD-3-Clause
#include "app/Run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <utility>

#include "app/CouplingLog.hpp"
#include "app/LogParts.hpp"
#include "app/RunLog.hpp"
#include "app/RunObserver.hpp"
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

coupling::Schedule schedule_named(std::string const& name)
{
    if (name == "overlapped") return coupling::Schedule::overlapped;
    return name == "iterated" ? coupling::Schedule::iterated : coupling::Schedule::serial;
}

coupling::ServerTerms terms_of(Case const& settings)
{
    CouplingSettings const& how = settings.coupling;
    return {.title = settings.title,
            .schedule = schedule_named(settings.coupling.schedule),
            .end_time = settings.run.until,
            .needs = needed_fields(settings),
            .fluid_steps = static_cast<int>(how.fluid_steps),
            .iteration = {.tolerance = how.tolerance,
                          .max_passes = static_cast<int>(how.max_passes),
                          .relaxation = how.relaxation,
                          .must_converge = how.must_converge}};
}

/// With both solvers at work at once, each of the client's ranks has a core.
exec::Execution execution_for(Case const& settings, coupling::Schedule schedule, int ranks)
{
    int threads = settings.dem.threads;
    if (threads == 0 && schedule == coupling::Schedule::overlapped)
        threads = std::max(1, exec::processor_count() - ranks);
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
                    DemSystem& system, output::Progress& progress, RunObserver& observer)
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
                                       observer.phase("settling the bed", at, settings.settle->duration);
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
               coupling::ClientInfo const& client, ParticleState particles, Materials const& materials,
               RunEvents& events, output::TraceChoice const& trace)
        : settings_(settings),
          server_(server),
          events_(events),
          schedule_(client.schedule.value_or(terms_of(settings).schedule)),
          observer_(settings, folder, server, events, client.name, schedule_, trace),
          execution_(execution_for(settings, schedule_, client.ranks)),
          mesh_(take_mesh(server)),
          walls_(mesh_, settings.walls.also, reach_of(settings, particles), settings.wall),
          inlets_(make_inlets(settings, materials)),
          system_(settings, execution_, materials, walls_, std::move(particles)),
          folder_(folder),
          log_(settings, folder, mesh_, system_, client, schedule_),
          coupling_log_(folder, mesh_, schedule_),
          engine_(settings, execution_, mesh_, walls_, client.fluid, system_)
    {
    }

    void start(std::optional<std::filesystem::path> const& restart)
    {
        std::string const note = note_on_small_cells(mesh_, reach_of(settings_, std::as_const(system_).particles()));
        if (!note.empty()) events_.warn("small_cells", note);
        if (restart)
        {
            system_.prepare();
            start_ = at_ = read_checkpoint(*restart, settings_, inlets_, system_, engine_.weight_reuse());
            require_time_left(*restart, at_, settings_.run.until);
            events_.say("restarted", fmt::format("{} particles from {:.6g} s", system_.particles().count(), at_.time),
                        {{"checkpoint", restart->string()}, {"time_s", at_.time}});
        }
        else
            settle();
        engine_.set_inlets(inlets_);
        engine_.map_initial_state();
        engine_.monitor(log_.monitored_cells());
        server_.accept_mesh(engine_.fields(), {}, cells_to_send(at_.time));
        if (!server_.shared_memory_note().empty()) events_.warn("plain_frames", server_.shared_memory_note());
        events_.note("mesh_accepted", "the mesh is accepted",
                     {{"cells", static_cast<double>(mesh_.cell_count())},
                      {"particles", static_cast<double>(system_.particles().count())}});
    }

    void couple()
    {
        auto asked = std::chrono::steady_clock::now();
        while (auto fluid = server_.receive_fluid())
        {
            double const output_time = fluid->pass == 0 ? begin_step(*fluid, seconds_since(asked)) : repeat_step();
            observer_.begin_step(*fluid);
            StepReport report = engine_.advance(fluid->step, fluid->fields, whole(*fluid));
            report.timings.output = output_time;
            if (interrupted()) server_.request_stop("interrupted by the user");
            server_.send_solid(engine_.fields(), report.timings, cells_to_send(fluid->step.time + fluid->step.dt));
            log_.record(*fluid, report, engine_);
            coupling_log_.answered(*fluid, report, engine_);
            reached_ = fluid->step.time + fluid->step.dt;
            if (schedule_ != coupling::Schedule::iterated) accept();
            observer_.end_step(*fluid, report, static_cast<double>(system_.particles().count()));
            asked = std::chrono::steady_clock::now();
        }
    }

    /// Figures and the last state of the particles, whatever ended the run.
    void finish()
    {
        accept();
        coupling_log_.add_to(log_.summary());
        observer_.finish(log_.summary());
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

    /// For the solid of a step that ends at `time` [s], and the fluid of the next one. In schedule iterated that may be
    /// the same step once more.
    coupling::StepCells cells_to_send(double time)
    {
        coupling::StepCells cells = engine_.step_cells(schedule_ == coupling::Schedule::serial);
        if (log_.expects_frame(time) || schedule_ == coupling::Schedule::iterated) cells.needed.clear();
        return cells;
    }

    /// Returns how long output took [s].
    double begin_step(coupling::FluidState const& fluid, double waited)
    {
        accept();
        coupling_log_.arrived(fluid, waited, server_.bytes());
        if (at_.step == start_.step) check_start(fluid.step);
        double const output_time = log_.sample(fluid, engine_);
        if (schedule_ == coupling::Schedule::iterated) engine_.remember();
        return output_time;
    }

    /// The same for a pass after the first.
    double repeat_step()
    {
        engine_.go_back();
        return 0;
    }

    /// The step that was answered last stands.
    void accept()
    {
        if (!reached_) return;
        log_.accept();
        double const before = at_.time;
        at_ = {at_.step + 1, *reached_};
        reached_.reset();
        if (is_checkpoint_between(before, at_.time)) keep();
    }

    void settle()
    {
        check_particles_against_walls(system_.particles(), walls_);
        check_wall_steps(settings_, walls_, mesh_, smallest_radius(settings_, std::as_const(system_).particles()));
        settle_or_load(settings_, execution_, walls_, mesh_, system_, log_.progress(), observer_);
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
        events_.note("checkpoint", "the particles are saved", {{"time_s", at_.time}});
    }

    Case const& settings_;
    coupling::Server& server_;
    RunEvents& events_;
    coupling::Schedule schedule_;
    RunObserver observer_;
    exec::Execution execution_;
    PolyMesh mesh_;
    WallGeometry walls_;
    std::vector<Inlet> inlets_;
    DemSystem system_;
    std::filesystem::path folder_;
    RunLog log_;
    CouplingLog coupling_log_;
    CoupledEngine engine_;
    RunPoint start_, at_;            ///< in coupling steps
    std::optional<double> reached_;  ///< end of a step that is not accepted yet [s]
};

}  // namespace

void run(Case const& settings, std::filesystem::path const& folder, std::optional<std::filesystem::path> const& restart,
         output::TraceChoice const& trace)
{
    refuse_periodic_coupled_run(settings);
    std::filesystem::create_directories(folder);
    RunEvents events(folder);
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
                             .connect_time = settings.coupling.connect_time,
                             .keys = settings.coupling.keys,
                             .log = [&events](std::string const& text) { events.warn("coupling", text); },
                             .clock_origin = clock_origin()});
    events.say("listening",
               fmt::format("{} particles, waiting for a client at {}", particles.count(), server.endpoint()),
               {{"version", GIMDEM_VERSION}, {"case", settings.title}, {"endpoint", server.endpoint()}});
    server.publish({.title = settings.title,
                    .activity = "waiting for a client",
                    .folder = std::filesystem::absolute(folder).string(),
                    .schedule = settings.coupling.schedule,
                    .end_time = settings.run.until,
                    .figures = {}});
    try
    {
        coupling::ClientInfo const client = server.wait_for_client(terms_of(settings));
        heed_interrupts();
        events.say("client_connected", client.name + " connected", {{"client", client.name}});
        CoupledRun coupled(settings, folder, server, client, std::move(particles), materials, events, trace);
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
        events.note("finished", server.goodbye_reason());
    }
    catch (UserError const& error)
    {
        server.abort(error.what());
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

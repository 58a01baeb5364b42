// SPDX-License-Identifier: BSD-3-Clause
#include "app/CoupledRun.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/LogParts.hpp"
#include "app/Run.hpp"
#include "core/Error.hpp"
#include "engine/CellSizeCheck.hpp"
#include "engine/InletFlow.hpp"
#include "engine/Settling.hpp"
#include "engine/StartChecks.hpp"
#include "engine/WallStartCheck.hpp"
#include "engine/WallStepCheck.hpp"

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

}  // namespace

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

CoupledRun::CoupledRun(Case const& settings, std::filesystem::path const& folder, coupling::Server& server,
                       coupling::ClientInfo client, ParticleState particles, Materials const& materials,
                       RunEvents& events, output::TraceChoice const& trace)
    : settings_(settings),
      folder_(folder),
      server_(server),
      events_(events),
      client_(std::move(client)),
      schedule_(client_.schedule.value_or(terms_of(settings).schedule)),
      observer_(settings, folder, server, events, client_.name, schedule_, trace),
      execution_(execution_for(settings, schedule_, client_.ranks)),
      mesh_(take_mesh(server)),
      walls_(mesh_, settings.walls.also, reach_of(settings, particles), settings.wall),
      inlets_(make_inlets(settings, materials)),
      system_(settings, execution_, materials, walls_, std::move(particles)),
      log_(settings, folder, mesh_, system_, client_, schedule_),
      coupling_log_(folder, mesh_, schedule_),
      engine_(settings, execution_, mesh_, walls_, client_.fluid, system_)
{
    engine_.monitor(log_.monitored_cells());
}

void CoupledRun::start(std::optional<std::filesystem::path> const& restart)
{
    std::string const note = note_on_small_cells(mesh_, reach_of(settings_, std::as_const(system_).particles()));
    if (!note.empty()) events_.warn("small_cells", note);
    engine_.set_inlets(inlets_);
    if (restart)
    {
        system_.prepare();
        load(*restart);
        require_time_left(*restart, at_, settings_.run.until);
        if (client_.resume && client_.resume->step != at_.step)
            throw UserError(
                fmt::format("the client goes on from the checkpoint of step {}, the particles from that of "
                            "step {} (they must be one pair); restart both from the same one",
                            client_.resume->step, at_.step));
    }
    else
    {
        settle();
        engine_.map_initial_state();
    }
    accept_mesh();
}

void CoupledRun::go_on(coupling::ClientInfo const& client)
{
    require_same(client);
    auto const file = find_checkpoint(folder_, client.resume->step);
    if (!file)
        throw UserError(
            fmt::format("there is no checkpoint of step {} in {} (the client goes on from it); start it "
                        "from a newer state",
                        client.resume->step, (folder_ / "checkpoints").string()));
    if (mesh_hash(server_.receive_mesh()) != engine_.mapped().mesh)
    {
        server_.reject_mesh("it is not the mesh of before");
        throw UserError("the client has come back with another mesh (the particles go on on that of before)");
    }
    bytes_before_ += bytes_;
    engine_.forget_particles();
    reached_.reset();
    load(*file);
    log_.rewind(at_.time);
    coupling_log_.rewind(at_.time);
    accept_mesh();
}

void CoupledRun::couple()
{
    auto asked = std::chrono::steady_clock::now();
    while (auto fluid = server_.receive_fluid())
    {
        double const output_time =
            fluid->pass == 0 ? begin_step(*fluid, seconds_since(asked)) : repeat_step(seconds_since(asked));
        observer_.begin_step(*fluid);
        is_in_step_ = true;
        StepReport report = engine_.advance(fluid->step, fluid->fields, whole(*fluid));
        server_.wake_client();
        is_in_step_ = false;
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

coupling::SavedCheckpoint CoupledRun::save(coupling::CheckpointRequest const& request)
{
    is_asked_ = true;
    accept();
    complete_step_ = std::max(complete_step_, std::min(request.complete_step, at_.step));
    if (at_.step == 0) at_.time = request.time;
    if (std::abs(request.time - at_.time) > 1e-9 * std::abs(at_.time))
        throw UserError(
            fmt::format("the client asks for a checkpoint at {:.9g} s, the particles are at {:.9g} s (they must be of "
                        "one time); ask between two steps, with the time where the last one ended",
                        request.time, at_.time));
    keep();
    return {.step = at_.step, .time = at_.time, .name = checkpoint_file(folder_, at_).filename().string()};
}

void CoupledRun::finish()
{
    accept();
    finish_records();
    keep();
}

void CoupledRun::finish_after_failure() noexcept
{
    auto const attempt = [this](auto const& write)
    {
        try
        {
            write();
        }
        catch (std::exception const& error)
        {
            events_.warn("not_written", error.what());
        }
    };
    attempt([&] { accept(); });
    attempt([&] { finish_records(); });
    if (!is_in_step_) attempt([&] { keep(); });
}

void CoupledRun::finish_records()
{
    coupling_log_.add_to(log_.summary());
    observer_.finish(log_.summary());
    log_.finish(bytes_before_ + server_.bytes());
}

std::function<coupling::FluidFields()> CoupledRun::whole(coupling::FluidState& fluid)
{
    if (fluid.is_complete) return {};
    return [this, &fluid]
    {
        server_.complete(fluid);
        return fluid.fields;
    };
}

// In schedule iterated the next fluid may be that of the same step once more.
coupling::StepCells CoupledRun::cells_to_send(double time)
{
    coupling::StepCells cells = engine_.step_cells(schedule_ == coupling::Schedule::serial);
    if (log_.expects_frame(time) || schedule_ == coupling::Schedule::iterated) cells.needed.clear();
    return cells;
}

double CoupledRun::begin_step(coupling::FluidState const& fluid, double waited)
{
    accept();
    bytes_ = server_.bytes();
    coupling_log_.arrived(fluid, waited, bytes_);
    if (at_.step == start_.step) check_start(fluid.step);
    double const output_time = log_.sample(fluid, engine_);
    if (schedule_ == coupling::Schedule::iterated) engine_.remember();
    return output_time;
}

double CoupledRun::repeat_step(double waited)
{
    coupling_log_.came_again(waited);
    engine_.go_back();
    return 0;
}

void CoupledRun::accept()
{
    if (!reached_) return;
    log_.accept();
    double const before = at_.time;
    at_ = {at_.step + 1, *reached_};
    reached_.reset();
    if (!is_asked_ && is_checkpoint_between(before, at_.time)) keep();
}

void CoupledRun::settle()
{
    check_particles_against_walls(system_.particles(), walls_);
    check_wall_steps(settings_, walls_, mesh_, smallest_radius(settings_, std::as_const(system_).particles()));
    settle_or_load(settings_, execution_, walls_, mesh_, system_, log_.progress(), observer_);
    Vec3 const up = upward(settings_);
    log_.summary().add("settled_height", bed_height(system_.particles(), mesh_, up), "m");
    log_.summary().add("settled_height_2z", 2 * centre_of_mass_height(system_.particles(), mesh_, up), "m");
}

void CoupledRun::load(std::filesystem::path const& file)
{
    MappedState mapped;
    start_ = at_ = read_checkpoint(file, settings_, inlets_, system_, engine_.weight_reuse(), &mapped);
    kept_ = at_.step;
    is_in_step_ = false;
    engine_.resume(mapped);
    events_.say("restarted", fmt::format("{} particles from {:.6g} s", system_.particles().count(), at_.time),
                {{"checkpoint", file.string()}, {"time_s", at_.time}});
}

void CoupledRun::accept_mesh()
{
    server_.accept_mesh(engine_.fields(), {}, cells_to_send(at_.time));
    if (!server_.shared_memory_note().empty()) events_.warn("plain_frames", server_.shared_memory_note());
    events_.note("mesh_accepted", "the mesh is accepted",
                 {{"cells", static_cast<double>(mesh_.cell_count())},
                  {"particles", static_cast<double>(system_.particles().count())}});
}

void CoupledRun::require_same(coupling::ClientInfo const& client) const
{
    bool const same = client.fluid.density == client_.fluid.density &&
                      client.fluid.viscosity == client_.fluid.viscosity &&
                      client.schedule.value_or(terms_of(settings_).schedule) == schedule_;
    if (same) return;
    throw UserError(
        "the client has come back with another fluid or schedule (the run goes on with those of before); start it as "
        "before, or run the case again");
}

/// The fluid of a restarted run must begin where the particles are. A wrong pair is off by a step at least; names
/// of time folders are off by rounding.
void CoupledRun::check_start(coupling::Step const& first) const
{
    if (start_.step == 0 || std::abs(first.time - start_.time) < 0.1 * first.dt) return;
    throw UserError(
        fmt::format("the fluid begins at {:.9g} s, the checkpoint of the particles is at {:.9g} s (they must be of "
                    "one time); start the client from its fields at {:.9g} s",
                    first.time, start_.time, start_.time));
}

bool CoupledRun::is_checkpoint_between(double before, double now) const
{
    double const interval = settings_.output.checkpoint_interval;
    auto const count = [=](double time) { return std::floor(time / interval + 1e-6); };
    return interval > 0 && count(now) > count(before);
}

void CoupledRun::keep()
{
    if (kept_ == at_.step) return;
    MappedState const mapped = engine_.mapped();
    write_checkpoint(checkpoint_file(folder_, at_), settings_, at_, inlets_, system_, engine_.weight_reuse(), &mapped);
    kept_ = at_.step;
    log_.remember(at_.time);
    if (is_asked_)
        keep_newest_checkpoints(folder_, complete_step_);
    else
        keep_newest_checkpoints(folder_);
    events_.note("checkpoint", "the particles are saved", {{"time_s", at_.time}});
}

}  // namespace gimdem::app

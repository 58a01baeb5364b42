// SPDX-License-Identifier: BSD-3-Clause
#include "app/CoupledRun.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/LogParts.hpp"
#include "app/Run.hpp"
#include "app/Terms.hpp"
#include "core/Error.hpp"
#include "engine/InletFlow.hpp"

namespace gimdem::app
{

namespace
{

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

}  // namespace

CoupledRun::CoupledRun(Case const& settings, std::filesystem::path const& folder, coupling::Server& server,
                       coupling::ClientInfo client, ParticleState particles, Materials const& materials,
                       RunEvents& events, output::TraceChoice const& trace)
    : settings_(settings),
      folder_(folder),
      server_(server),
      events_(events),
      client_(std::move(client)),
      schedule_(schedule_of(settings, client_)),
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

}  // namespace gimdem::app

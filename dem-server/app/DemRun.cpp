// SPDX-License-Identifier: BSD-3-Clause
#include "app/DemRun.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/DemLog.hpp"
#include "app/Run.hpp"
#include "app/RunEvents.hpp"
#include "core/Error.hpp"
#include "engine/DomainBounds.hpp"
#include "engine/InletFlow.hpp"
#include "engine/StartChecks.hpp"
#include "engine/WallBorderCheck.hpp"
#include "engine/WallStartCheck.hpp"
#include "engine/WallStepCheck.hpp"
#include "mesh/BoxDomain.hpp"
#include "particles/Insertion.hpp"

namespace gimdem::app
{

namespace
{

/// How often something is due that is wanted every `interval` [s]: every so many steps; 0: never.
std::int64_t steps_of(double interval, double dt)
{
    return interval > 0 ? std::max<std::int64_t>(1, std::llround(interval / dt)) : 0;
}

class DemRun
{
public:
    DemRun(Case const& settings, std::filesystem::path const& folder, Materials const& materials,
           ParticleState particles)
        : settings_(settings),
          events_(folder),
          folder_(folder),
          dt_(settings.dem.time_step),
          last_step_(std::llround(std::ceil(settings.run.until / dt_ - 1e-9))),
          row_steps_(steps_of(settings.output.sample_interval, dt_)),
          frame_steps_(steps_of(settings.output.particle_interval, dt_)),
          checkpoint_steps_(steps_of(settings.output.checkpoint_interval, dt_)),
          mesh_(box_mesh(settings.domain)),
          bounds_(settings.domain),
          walls_(mesh_, settings.walls.also, reach_of(settings, particles), settings.wall),
          inlets_(make_inlets(settings, materials)),
          system_(settings, exec::make_execution(settings.dem.backend, settings.dem.threads, settings.dem.sorting),
                  materials, walls_, std::move(particles))
    {
        ParticleState const& start = std::as_const(system_).particles();
        check_particles_against_walls(start, walls_);
        check_wall_steps(settings, walls_, mesh_, smallest_radius(settings, start));
        check_walls_in_periodic_box(settings.domain, walls_, reach_of(settings, start));
        system_.prepare();
        system_.begin_coupling_step(nullptr);
        system_.let_walls_move(true);
    }

    void restart(std::filesystem::path const& file)
    {
        start_ = at_ = read_checkpoint(file, settings_, inlets_, system_);
        require_time_left(file, at_, settings_.run.until);
    }

    void run()
    {
        events_.say("started",
                    fmt::format("{} particles, no fluid, from {:.6g} s", system_.particles().count(), at_.time),
                    {{"version", GIMDEM_VERSION}, {"case", settings_.title}});
        DemLog log(settings_, folder_, mesh_, system_, inlets_, start_);
        try
        {
            while (at_.step < last_step_ && !interrupted())
                step(log);
        }
        catch (...)
        {
            log.finish(at_);
            events_.fail("the run ended with an error");
            throw;
        }
        log.write_row(at_);
        if (frame_steps_ > 0) log.write_frame(at_.time);
        log.finish(at_);
        keep();
        events_.note("finished", interrupted() ? "stopped as asked" : "end time reached", {{"time_s", at_.time}});
    }

private:
    // The order matters: a run that starts from the checkpoint goes on with what comes after it.
    void step(DemLog& log)
    {
        auto const due = [&](std::int64_t every) { return every > 0 && at_.step % every == 0; };
        if (due(checkpoint_steps_) && at_.step > start_.step) keep();
        insert_from(inlets_, at_.time, system_);
        if (due(row_steps_)) log.write_row(at_);
        if (due(frame_steps_)) log.write_frame(at_.time);
        system_.step(dt_);
        at_.time = static_cast<double>(++at_.step) * dt_;
        speed_.add(coupling::clock_now(), at_.time);
        events_.progress(at_.time, settings_.run.until, speed_);
        if (at_.step % steps_between_looks == 0) bounds_.remove_leavers(system_);
    }

    void keep()
    {
        write_checkpoint(checkpoint_file(folder_, at_), settings_, at_, inlets_, system_);
        keep_newest_checkpoints(folder_);
    }

    /// A particle beyond an open side may go on for so many steps.
    static constexpr std::int64_t steps_between_looks = 20;

    Case const& settings_;
    RunEvents events_;
    output::SpeedMeter speed_;
    std::filesystem::path folder_;
    double dt_;
    std::int64_t last_step_, row_steps_, frame_steps_, checkpoint_steps_;
    PolyMesh mesh_;
    DomainBounds bounds_;
    WallGeometry walls_;
    std::vector<Inlet> inlets_;
    DemSystem system_;
    RunPoint start_, at_;
};

}  // namespace

void run_alone(Case const& settings, std::filesystem::path const& folder,
               std::optional<std::filesystem::path> const& restart)
{
    std::filesystem::create_directories(folder);
    Materials const materials(settings);
    ParticleState particles = insert_particles(settings, materials);
    check_time_step(settings, materials, particles);
    check_overlaps(exec::make_execution(settings.dem.backend, settings.dem.threads), particles,
                   Domain::of(settings.domain));
    DomainBounds(settings.domain).check_start(particles);
    heed_interrupts();
    DemRun alone(settings, folder, materials, std::move(particles));
    if (restart) alone.restart(*restart);
    alone.run();
}

}  // namespace gimdem::app

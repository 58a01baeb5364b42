// SPDX-License-Identifier: BSD-3-Clause
#include "app/RunObserver.hpp"

#include "app/LogParts.hpp"

namespace gimdem::app
{

RunObserver::RunObserver(Case const& settings, std::filesystem::path const& folder, coupling::Server& server,
                         RunEvents& events, std::string const& client, coupling::Schedule schedule,
                         output::TraceChoice const& trace)
    : server_(server), events_(events), until_(settings.run.until)
{
    status_.title = settings.title;
    status_.folder = std::filesystem::absolute(folder).string();
    status_.schedule = coupling::name_of(schedule);
    if (trace.steps > 0) trace_.emplace(folder / "trace.json", clock_origin(), trace, client);
    phase("taking the mesh", coupling::not_known, coupling::not_known);
}

void RunObserver::phase(std::string const& activity, double time, double until)
{
    if (activity != status_.activity) events_.note("phase", activity);
    status_.activity = activity;
    status_.time = time;
    status_.end_time = until;
    server_.publish(status_);
}

void RunObserver::begin_step(coupling::FluidState const& fluid)
{
    computing_ = coupling::clock_now();
    if (first_ > 0) return;
    first_ = computing_;
    phase("coupled steps", fluid.step.time, until_);
}

void RunObserver::end_step(coupling::FluidState const& fluid, StepReport const& report, double particles)
{
    double const time = fluid.step.time + fluid.step.dt;
    speed_.add(coupling::clock_now(), time);
    events_.progress(time, until_, speed_);
    publish(fluid, report, particles);
    if (trace_) trace(fluid, report, particles);
}

void RunObserver::publish(coupling::FluidState const& fluid, StepReport const& report, double particles)
{
    status_.time = fluid.step.time + fluid.step.dt;
    status_.steps_per_second = speed_.steps_per_second();
    status_.wall_per_simulated = speed_.wall_per_simulated();
    status_.figures = {{"particles", particles, "1"},
                       {"void_fraction_min", report.void_fraction_min, "1"},
                       {"void_fraction_max", report.void_fraction_max, "1"},
                       {"momentum_imbalance", report.momentum_imbalance, "1"},
                       {"volume_imbalance", report.volume_imbalance, "1"},
                       {"dem_steps_per_step", static_cast<double>(report.dem_steps), "1"},
                       {"dem_time", report.timings.compute, "s"},
                       {"mapping_time", report.timings.mapping, "s"},
                       {"cfd_time", fluid.previous.compute, "s"}};
    status_.figures.insert(status_.figures.end(), fluid.monitors.begin(), fluid.monitors.end());
    server_.publish(status_);
}

void RunObserver::trace(coupling::FluidState const& fluid, StepReport const& report, double particles)
{
    double const moved = particles * static_cast<double>(report.dem_steps);
    coupling::ServerTimes const& times = server_.step_times();
    // Of a pass that is repeated, the client tells no timings.
    coupling::Timings const timings = fluid.pass > 0 ? coupling::Timings{} : fluid.previous;
    if (fluid.clock) trace_->add(fluid.previous_times, timings, *fluid.clock);
    trace_->add({fluid.step.number, times, computing_, report.timings, coupling::clock_now()},
                {{"void_fraction_min", report.void_fraction_min},
                 {"courant_max", monitor(fluid, "courant_max")},
                 {"particle_steps_per_second", report.timings.compute > 0 ? moved / report.timings.compute : 0}});
}

void RunObserver::finish(output::Summary& summary)
{
    phase("writing the results", status_.time, until_);
    if (!trace_) return;
    if (auto const& last = server_.last_client_step()) trace_->add(last->times, last->timings, last->clock);
    double const wall = coupling::clock_now() - first_;
    if (first_ > 0 && wall > 0) summary.add("trace_cost", trace_->cost() / wall, "1");
}

}  // namespace gimdem::app

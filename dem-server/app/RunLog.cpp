// SPDX-License-Identifier: BSD-3-Clause
#include "app/RunLog.hpp"

#include <iostream>

#include "app/LogParts.hpp"

namespace gimdem::app
{

namespace
{

using Clock = std::chrono::steady_clock;

}  // namespace

RunLog::RunLog(Case const& settings, std::filesystem::path folder, PolyMesh const& mesh, DemSystem const& system,
               coupling::ClientInfo const& client, coupling::Schedule schedule)
    : settings_(settings),
      folder_(std::move(folder)),
      mesh_(mesh),
      system_(system),
      fluid_(client.fluid),
      schedule_(schedule),
      frames_(folder_, mesh.topology()),
      series_(settings, mesh, system)
{
}

double RunLog::sample(coupling::FluidState const& fluid, CoupledEngine const& engine)
{
    auto const start = Clock::now();
    if (totals_.steps() == 0)
    {
        start_ = start;
        totals_.begin(fluid.step.time);
        series_.open(folder_ / "bed.csv", fluid);
    }
    if (is_due(fluid.step.time, rows_, settings_.output.sample_interval))
    {
        series_.write_row(fluid, engine);
        ++rows_;
    }
    if (frame_is_due_.value_or(is_due(fluid.step.time, frame_count_, settings_.output.particle_interval)))
        write_frame(fluid, engine);
    frame_is_due_.reset();
    return seconds_since(start);
}

/// Is the count-th of something due that is wanted every `interval`? Times in seconds.
bool RunLog::is_due(double time, std::int64_t count, double interval) const
{
    double const since = series_.is_open() ? time - totals_.first_time() : 0;
    return interval > 0 && since >= (static_cast<double>(count) - 1e-6) * interval;
}

bool RunLog::expects_frame(double time)
{
    frame_is_due_ = is_due(time, frame_count_, settings_.output.particle_interval);
    return *frame_is_due_;
}

void RunLog::record(coupling::FluidState const& fluid, StepReport const& report, CoupledEngine const& engine)
{
    totals_.add_work(fluid, report);
    pending_ = {fluid.step, report, series_.pressure_drop(fluid.fields), engine.particle_clips()};
    progress_.show(output::ProgressSample{.time = fluid.step.time + fluid.step.dt,
                                          .until = settings_.run.until,
                                          .dem_ms = 1e3 * (report.timings.compute + report.timings.mapping),
                                          .cfd_ms = 1e3 * fluid.previous.compute,
                                          .void_fraction_min = report.void_fraction_min,
                                          .void_fraction_max = report.void_fraction_max,
                                          .courant = monitor(fluid, "courant_max"),
                                          .speed_max = fastest(system_.particles())});
}

void RunLog::rewind(double time)
{
    pending_.reset();
    rows_ = series_.rewind(time);
    if (frame_count_ > 0) frame_count_ = frames_.resume(time);
}

void RunLog::accept()
{
    if (!pending_) return;
    totals_.add(pending_->step, pending_->report, pending_->particle_clips);
    series_.add(pending_->step, pending_->report, pending_->pressure_drop);
    pending_.reset();
}

void RunLog::write_frame(coupling::FluidState const& fluid, CoupledEngine const& engine)
{
    auto const solid = engine.fields();
    std::vector<output::CellField> fields{{"void_fraction", 1, as_span(solid.void_fraction)},
                                          {"momentum_source", 3, as_span(solid.momentum_source)}};
    auto const add = [&](char const* name, int components, coupling::Span<double const> values)
    {
        if (!values.empty()) fields.push_back({name, components, as_span(values)});
    };
    add("velocity", 3, fluid.fields.velocity);
    add("pressure", 1, fluid.fields.pressure);
    add("pressure_gradient", 3, fluid.fields.pressure_gradient);
    add("void_fraction_gradient", 3, fluid.fields.void_fraction_gradient);
    with_particle_frame(system_.particles(), fluid.step.time,
                        [&](output::ParticleFrame const& frame) { frames_.write(fluid.step.time, frame, fields); });
    ++frame_count_;
}

double RunLog::gas_weight() const
{
    double volume = 0;
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
        volume += mesh_.volume(c);
    for (std::int64_t p = 0; p < system_.particles().count(); ++p)
        volume -= system_.particles().volume(p);
    Triple const& g = settings_.dem.gravity;
    return fluid_.density * volume * Vec3(g[0], g[1], g[2]).norm();
}

double RunLog::mean_diameter() const
{
    double sum = 0;
    for (Quad const& x : system_.particles().position.host())
        sum += 2 * x.w;
    return system_.particles().count() > 0 ? sum / static_cast<double>(system_.particles().count()) : 0;
}

void RunLog::finish(double bytes)
{
    progress_.finish();
    double const wall = totals_.steps() > 0 ? seconds_since(start_) : 0;
    totals_.add_progress(summary_);
    summary_.add("particles", static_cast<double>(system_.particles().count()), "1");
    add_removed_by_cause(system_, summary_);
    add_removed(system_, summary_);
    summary_.add("mean_particle_diameter", mean_diameter(), "m");
    summary_.add("fluid_density", fluid_.density, "kg/m^3");
    summary_.add("fluid_viscosity", fluid_.viscosity, "Pa s");
    totals_.add_balances(summary_);
    if (series_.inlet() != nullptr) add_weights(patch_area(mesh_, *series_.inlet()));
    totals_.add_shares(wall, schedule_, summary_);
    if (totals_.steps() > 0) summary_.add("bytes_per_step", bytes / static_cast<double>(totals_.steps()), "B");
    summary_.print(std::cout);
    std::cout.flush();
    summary_.write(folder_ / "summary.json");
}

void RunLog::add_weights(double inlet_area)
{
    Triple const& g = settings_.dem.gravity;
    double const bed_weight = total_mass(system_.particles()) * Vec3(g[0], g[1], g[2]).norm();
    summary_.add("bed_weight_per_area", bed_weight / inlet_area, "Pa");
    summary_.add("gas_weight_per_area", gas_weight() / inlet_area, "Pa");
    summary_.add("inlet_area", inlet_area, "m^2");
}

}  // namespace gimdem::app

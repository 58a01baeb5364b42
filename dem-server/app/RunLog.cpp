// SPDX-License-Identifier: BSD-3-Clause
#include "app/RunLog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "app/LogParts.hpp"
#include "core/Error.hpp"

namespace gimdem::app
{

namespace
{

using Clock = std::chrono::steady_clock;

double monitor(coupling::FluidState const& fluid, std::string const& name)
{
    for (coupling::Monitor const& m : fluid.monitors)
        if (m.name == name) return m.value;
    return std::numeric_limits<double>::quiet_NaN();
}

std::span<double const> as_span(coupling::Span<double const> s)
{
    return {s.data(), s.size()};
}

coupling::Patch const* named_patch(PolyMesh const& mesh, std::string const& name, char const* key)
{
    if (name.empty()) return nullptr;
    if (coupling::Patch const* const patch = mesh.find_patch(name)) return patch;
    throw UserError(
        fmt::format("[output] {} = \"{}\" is no patch of the client's mesh; name one of its patches", key, name));
}

/// Is the count-th of something due that is wanted every `interval` [s]?
bool is_due(double since_start, std::int64_t count, double interval)
{
    return interval > 0 && since_start >= (static_cast<double>(count) - 1e-6) * interval;
}

}  // namespace

RunLog::RunLog(Case const& settings, std::filesystem::path folder, PolyMesh const& mesh, DemSystem const& system,
               coupling::ClientInfo const& client, coupling::Schedule schedule)
    : settings_(settings),
      folder_(std::move(folder)),
      mesh_(mesh),
      system_(system),
      fluid_(client.fluid),
      schedule_(schedule),
      up_(upward(settings)),
      inlet_(named_patch(mesh, settings.output.inlet, "inlet")),
      outlet_(named_patch(mesh, settings.output.outlet, "outlet")),
      frames_(folder_, mesh.topology())
{
    for (PlaneSettings const& plane : settings.output.planes)
        planes_.emplace_back(mesh, plane);
}

double RunLog::sample(coupling::FluidState const& fluid, CoupledEngine const& engine)
{
    auto const start = Clock::now();
    if (steps_ == 0)
    {
        start_ = start;
        first_time_ = fluid.step.time;
        last_momentum_ = momentum(system_.particles());
        open_series(fluid);
    }
    if (is_due(fluid.step.time - first_time_, rows_, settings_.output.sample_interval)) write_row(fluid, engine);
    if (frame_is_due_.value_or(is_frame_due(fluid.step.time))) write_frame(fluid, engine);
    frame_is_due_.reset();
    return seconds_since(start);
}

bool RunLog::is_frame_due(double time) const
{
    double const since = series_ ? time - first_time_ : 0;
    return is_due(since, frame_count_, settings_.output.particle_interval);
}

bool RunLog::expects_frame(double time)
{
    frame_is_due_ = is_frame_due(time);
    return *frame_is_due_;
}

std::vector<std::int32_t> RunLog::monitored_cells() const
{
    std::vector<std::int32_t> cells;
    for (PlaneSection const& plane : planes_)
        plane.list_cells(cells);
    for (coupling::Patch const* const patch : {inlet_, outlet_})
        if (patch != nullptr)
            cells.insert(cells.end(), mesh_.topology().owner.begin() + patch->start_face,
                         mesh_.topology().owner.begin() + patch->start_face + patch->face_count);
    return cells;
}

void RunLog::record(coupling::FluidState const& fluid, StepReport const& report, CoupledEngine const& engine)
{
    double const dt = fluid.step.dt;
    ++steps_;
    last_time_ = fluid.step.time + dt;
    dem_steps_ += report.dem_steps;
    whole_fluids_ += report.fluid_was_wanted;
    cell_clips_ += report.cell_clips;
    particle_clips_ = engine.particle_clips();
    momentum_imbalance_ = std::max(momentum_imbalance_, report.momentum_imbalance);
    volume_imbalance_ = std::max(volume_imbalance_, report.volume_imbalance);
    void_fraction_min_ = std::min(void_fraction_min_, report.void_fraction_min);
    void_fraction_max_ = std::max(void_fraction_max_, report.void_fraction_max);
    dem_.compute += report.timings.compute;
    dem_.mapping += report.timings.mapping;
    dem_.output += report.timings.output;
    cfd_.compute += fluid.previous.compute;
    exchange_ = fluid.exchange;
    client_waiting_ = fluid.waiting;

    double const drop = pressure_drop(fluid.fields);
    interval_.duration += dt;
    interval_.drag += dt * report.drag_force.vec();
    interval_.pressure += dt * report.pressure_force.vec();
    interval_.wall += dt * report.wall_force.vec();
    interval_.pressure_drop += dt * drop;
    interval_.momentum_imbalance = std::max(interval_.momentum_imbalance, report.momentum_imbalance);
    interval_.volume_imbalance = std::max(interval_.volume_imbalance, report.volume_imbalance);
    interval_.clips += report.cell_clips;

    progress_.show(output::ProgressSample{.time = last_time_,
                                          .until = settings_.run.until,
                                          .dem_ms = 1e3 * (report.timings.compute + report.timings.mapping),
                                          .cfd_ms = 1e3 * fluid.previous.compute,
                                          .void_fraction_min = report.void_fraction_min,
                                          .void_fraction_max = report.void_fraction_max,
                                          .courant = monitor(fluid, "courant_max"),
                                          .speed_max = fastest(system_.particles())});
}

void RunLog::open_series(coupling::FluidState const& fluid)
{
    std::vector<output::Column> columns{{"time", "s"}, {"bed_height", "m"}, {"centre_of_mass", "m"}};
    if (inlet_ != nullptr && outlet_ != nullptr) columns.push_back({"pressure_drop", "Pa"});
    for (PlaneSettings const& plane : settings_.output.planes)
    {
        columns.push_back({"pressure_" + plane.name, "Pa"});
        columns.push_back({"void_fraction_" + plane.name, "1"});
    }
    for (auto const& [name, unit] :
         std::initializer_list<std::pair<char const*, char const*>>{{"void_fraction_min", "1"},
                                                                    {"void_fraction_max", "1"},
                                                                    {"speed_max", "m/s"},
                                                                    {"drag_force", "N"},
                                                                    {"pressure_force", "N"},
                                                                    {"wall_force", "N"},
                                                                    {"momentum_rate", "N"},
                                                                    {"momentum_imbalance", "1"},
                                                                    {"volume_imbalance", "1"},
                                                                    {"void_fraction_clips", "1"},
                                                                    {"particles", "1"}})
        columns.push_back({name, unit});
    for (coupling::Monitor const& m : fluid.monitors)
        columns.push_back({m.name, m.unit});
    series_.emplace(folder_ / "bed.csv", columns);
}

// Forces, the pressure drop and the imbalances are those of the interval since the last row (means, means, worst);
// everything else is of this instant. Forces and momentum are upward components.
void RunLog::write_row(coupling::FluidState const& fluid, CoupledEngine const& engine)
{
    ParticleState const& particles = system_.particles();
    std::span<double const> const void_fraction = engine.void_fraction().host();
    double const time = interval_.duration > 0 ? interval_.duration : 1;
    Vec3 const now = momentum(particles);
    std::vector<double> row{fluid.step.time, bed_height(particles, mesh_, up_),
                            centre_of_mass_height(particles, mesh_, up_)};
    if (inlet_ != nullptr && outlet_ != nullptr)
        row.push_back(interval_.duration > 0 ? interval_.pressure_drop / time : pressure_drop(fluid.fields));
    for (PlaneSection const& plane : planes_)
    {
        row.push_back(plane.mean(as_span(fluid.fields.pressure), as_span(fluid.fields.pressure_gradient)));
        row.push_back(plane.mean(void_fraction, as_span(fluid.fields.void_fraction_gradient)));
    }
    auto const [least, most] = std::minmax_element(void_fraction.begin(), void_fraction.end());
    row.insert(
        row.end(),
        {*least, *most, fastest(particles), interval_.drag.dot(up_) / time, interval_.pressure.dot(up_) / time,
         interval_.wall.dot(up_) / time, (now - last_momentum_).dot(up_) / time, interval_.momentum_imbalance,
         interval_.volume_imbalance, static_cast<double>(interval_.clips), static_cast<double>(particles.count())});
    for (coupling::Monitor const& m : fluid.monitors)
        row.push_back(m.value);
    series_->append(row);
    last_momentum_ = now;
    interval_ = {};
    ++rows_;
}

void RunLog::write_frame(coupling::FluidState const& fluid, CoupledEngine const& engine)
{
    ParticleState const& particles = system_.particles();
    auto const position = triples(particles.position);
    auto const velocity = triples(particles.velocity);
    auto const angular_velocity = triples(particles.angular_velocity);
    std::vector<double> radius;
    for (Quad const& x : particles.position.host())
        radius.push_back(x.w);
    output::ParticleFrame const frame{.time = fluid.step.time,
                                      .position = position,
                                      .radius = radius,
                                      .velocity = velocity,
                                      .angular_velocity = angular_velocity,
                                      .id = particles.id.host()};
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
    frames_.write(fluid.step.time, frame, fields);
    ++frame_count_;
}

double RunLog::pressure_drop(coupling::FluidFields const& fluid) const
{
    if (inlet_ == nullptr || outlet_ == nullptr || fluid.pressure.empty()) return 0;
    return patch_pressure(mesh_, *inlet_, fluid) - patch_pressure(mesh_, *outlet_, fluid);
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
    double const simulated = last_time_ - first_time_;
    double const wall = steps_ > 0 ? seconds_since(start_) : 0;
    summary_.add("simulated_time", simulated, "s");
    summary_.add("coupling_steps", static_cast<double>(steps_), "1");
    summary_.add("dem_steps", static_cast<double>(dem_steps_), "1");
    summary_.add("particles", static_cast<double>(system_.particles().count()), "1");
    add_removed_by_cause(system_, summary_);
    add_removed(system_, summary_);
    summary_.add("mean_particle_diameter", mean_diameter(), "m");
    summary_.add("fluid_density", fluid_.density, "kg/m^3");
    summary_.add("fluid_viscosity", fluid_.viscosity, "Pa s");
    summary_.add("momentum_imbalance", momentum_imbalance_, "1");
    summary_.add("volume_imbalance", volume_imbalance_, "1");
    summary_.add("void_fraction_min", void_fraction_min_, "1");
    summary_.add("void_fraction_max", void_fraction_max_, "1");
    summary_.add("void_fraction_clips", static_cast<double>(cell_clips_), "1");
    summary_.add("void_fraction_clips_at_particles", static_cast<double>(particle_clips_), "1");
    if (inlet_ != nullptr)
    {
        double const area = patch_area(mesh_, *inlet_);
        Triple const& g = settings_.dem.gravity;
        summary_.add("bed_weight_per_area", total_mass(system_.particles()) * Vec3(g[0], g[1], g[2]).norm() / area,
                     "Pa");
        summary_.add("gas_weight_per_area", gas_weight() / area, "Pa");
        summary_.add("inlet_area", area, "m^2");
    }
    if (simulated > 0)
    {
        auto const share = [&](double seconds) { return seconds / wall; };
        double const exchange = exchange_;
        double const work = dem_.compute + dem_.mapping + dem_.output + exchange +
                            (schedule_ == coupling::Schedule::serial ? cfd_.compute : 0);
        summary_.add("wall_time", wall, "s");
        summary_.add("wall_time_per_simulated_second", wall / simulated, "s");
        summary_.add("share_dem", share(dem_.compute), "1");
        summary_.add("share_mapping", share(dem_.mapping), "1");
        summary_.add("share_cfd", share(cfd_.compute), "1");
        summary_.add("share_exchange", share(exchange), "1");
        summary_.add("share_output", share(dem_.output), "1");
        summary_.add("share_waiting",
                     share(schedule_ == coupling::Schedule::serial ? std::max(0.0, wall - work) : client_waiting_),
                     "1");
        summary_.add("exchange_per_step", 1e6 * exchange / static_cast<double>(std::max<std::int64_t>(steps_, 1)), "us");
        summary_.add("whole_fluids_asked_for", static_cast<double>(whole_fluids_), "1");
        summary_.add("bytes_per_step", bytes / static_cast<double>(std::max<std::int64_t>(steps_, 1)), "B");
    }
    summary_.print(std::cout);
    std::cout.flush();
    summary_.write(folder_ / "summary.json");
}

}  // namespace gimdem::app

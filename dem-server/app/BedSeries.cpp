// SPDX-License-Identifier: BSD-3-Clause
#include "app/BedSeries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "core/Error.hpp"

namespace gimdem::app
{

namespace
{

coupling::Patch const* named_patch(PolyMesh const& mesh, std::string const& name, char const* key)
{
    if (name.empty()) return nullptr;
    if (coupling::Patch const* const patch = mesh.find_patch(name)) return patch;
    throw UserError(
        fmt::format("[output] {} = \"{}\" is no patch of the client's mesh; name one of its patches", key, name));
}

}  // namespace

std::span<double const> as_span(coupling::Span<double const> values)
{
    return {values.data(), values.size()};
}

BedSeries::BedSeries(Case const& settings, PolyMesh const& mesh, DemSystem const& system)
    : settings_(settings),
      mesh_(mesh),
      system_(system),
      up_(upward(settings)),
      inlet_(named_patch(mesh, settings.output.inlet, "inlet")),
      outlet_(named_patch(mesh, settings.output.outlet, "outlet"))
{
    for (PlaneSettings const& plane : settings.output.planes)
        planes_.emplace_back(mesh, plane);
}

void BedSeries::open(std::filesystem::path const& file, coupling::FluidState const& fluid)
{
    std::vector<output::Column> columns{{"time", "s"}, {"bed_height", "m"}, {"centre_of_mass", "m"}};
    if (has_pressure_drop()) columns.push_back({"pressure_drop", "Pa"});
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
    series_.emplace(file, columns);
    last_momentum_ = momentum(system_.particles());
}

void BedSeries::add(coupling::Step const& step, StepReport const& report, double pressure_drop)
{
    double const dt = step.dt;
    interval_.duration += dt;
    interval_.drag += dt * report.drag_force.vec();
    interval_.pressure += dt * report.pressure_force.vec();
    interval_.wall += dt * report.wall_force.vec();
    interval_.pressure_drop += dt * pressure_drop;
    interval_.momentum_imbalance = std::max(interval_.momentum_imbalance, report.momentum_imbalance);
    interval_.volume_imbalance = std::max(interval_.volume_imbalance, report.volume_imbalance);
    interval_.clips += report.cell_clips;
}

// Forces, the pressure drop and the imbalances are those of the interval since the last row (means, means, worst);
// everything else is of this instant. Forces and momentum are upward components.
// The row at that very time stays: it tells the interval before, and the next one begins there.
std::int64_t BedSeries::rewind(double time)
{
    interval_ = {};
    last_momentum_ = momentum(system_.particles());
    return series_ ? series_->keep_before(time + 2e-9 * std::abs(time)) : 0;
}

void BedSeries::write_row(coupling::FluidState const& fluid, CoupledEngine const& engine)
{
    ParticleState const& particles = system_.particles();
    std::span<double const> const void_fraction = engine.void_fraction().host();
    double const time = interval_.duration > 0 ? interval_.duration : 1;
    Vec3 const now = momentum(particles);
    std::vector<double> row{fluid.step.time, bed_height(particles, mesh_, up_),
                            centre_of_mass_height(particles, mesh_, up_)};
    if (has_pressure_drop())
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
}

double BedSeries::pressure_drop(coupling::FluidFields const& fluid) const
{
    if (!has_pressure_drop() || fluid.pressure.empty()) return 0;
    return patch_pressure(mesh_, *inlet_, fluid) - patch_pressure(mesh_, *outlet_, fluid);
}

}  // namespace gimdem::app

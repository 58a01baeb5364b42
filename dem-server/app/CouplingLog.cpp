// SPDX-License-Identifier: BSD-3-Clause
#include "app/CouplingLog.hpp"

#include <algorithm>
#include <array>

namespace gimdem::app
{

CouplingLog::CouplingLog(std::filesystem::path const& folder, PolyMesh const& mesh, coupling::Schedule schedule)
    : iterates_(schedule == coupling::Schedule::iterated),
      series_(folder / "coupling.csv", {{"step", "1"},
                                        {"time", "s"},
                                        {"dt", "s"},
                                        {"dem_steps", "1"},
                                        {"dem", "s"},
                                        {"cfd", "s"},
                                        {"wall", "s"},
                                        {"server_waiting", "s"},
                                        {"client_waiting", "s"},
                                        {"exchange", "s"},
                                        {"exchange_bytes", "B"},
                                        {"overlap_efficiency", "1"},
                                        {"lag_force", "1"},
                                        {"lag_solid_fraction", "1"},
                                        {"passes", "1"},
                                        {"residual", "1"}}),
      lag_(mesh)
{
}

void CouplingLog::arrived(coupling::FluidState const& fluid, double waited, double bytes)
{
    auto const now = std::chrono::steady_clock::now();
    if (running_) close(fluid, now, waited, bytes);
    running_ = {.step = fluid.step,
                .began = now,
                .client_waiting = fluid.waiting,
                .exchange = fluid.exchange,
                .bytes = bytes,
                .lag = {}};
}

void CouplingLog::rewind(double time)
{
    running_.reset();
    series_.keep_before(time, 1);
}

void CouplingLog::answered(coupling::FluidState const& fluid, StepReport const& report, CoupledEngine const& engine)
{
    ++running_->passes;
    running_->fluid_was_wanted |= report.fluid_was_wanted;
    running_->dem_steps = report.dem_steps;
    running_->dem += report.timings.compute + report.timings.mapping + report.timings.output;
    if (fluid.pass == 0) running_->lag = lag_.measure(engine.fields(), fluid.fields.velocity);
}

void CouplingLog::close(coupling::FluidState const& next, Time now, double waited, double bytes)
{
    output::StepTimes const times{running_->dem, next.previous.compute + next.previous.output,
                                  std::chrono::duration<double>(now - running_->began).count()};
    double const server_waiting = running_->server_waiting + waited;
    double const client_waiting = next.waiting - running_->client_waiting;
    overlap_.add(times);
    server_waiting_ += server_waiting;
    client_waiting_ += client_waiting;
    double const exchange = next.exchange - running_->exchange;
    exchange_ += exchange;
    whole_fluids_ += running_->fluid_was_wanted;
    double const dt = running_->step.dt;
    duration_ += dt;
    lag_sum_.force += dt * running_->lag.force;
    lag_sum_.solid_fraction += dt * running_->lag.solid_fraction;
    lag_worst_.force = std::max(lag_worst_.force, running_->lag.force);
    lag_worst_.solid_fraction = std::max(lag_worst_.solid_fraction, running_->lag.solid_fraction);
    series_.append(std::array{static_cast<double>(running_->step.number), running_->step.time, dt,
                              static_cast<double>(running_->dem_steps), times.dem, times.cfd, times.wall,
                              server_waiting, client_waiting, exchange, bytes - running_->bytes,
                              overlap_efficiency(times), running_->lag.force, running_->lag.solid_fraction,
                              static_cast<double>(running_->passes), next.residual});
    ++steps_;
    passes_ += running_->passes;
    most_passes_ = std::max(most_passes_, running_->passes);
    residual_worst_ = std::max(residual_worst_, next.residual);
}

void CouplingLog::add_to(output::Summary& summary) const
{
    if (duration_ <= 0) return;
    summary.add("overlap_efficiency", overlap_.efficiency(), "1");
    summary.add("overlap_vs_max", overlap_.wall_over_longer(), "1");
    summary.add("server_waiting", server_waiting_, "s");
    summary.add("client_waiting", client_waiting_, "s");
    summary.add("exchange_per_step", exchange_ / static_cast<double>(steps_), "s");
    summary.add("whole_fluids_asked_for", static_cast<double>(whole_fluids_), "1");
    summary.add("lag_force", lag_sum_.force / duration_, "1");
    summary.add("lag_force_worst", lag_worst_.force, "1");
    summary.add("lag_solid_fraction", lag_sum_.solid_fraction / duration_, "1");
    summary.add("lag_solid_fraction_worst", lag_worst_.solid_fraction, "1");
    if (!iterates_) return;
    summary.add("passes_per_step", static_cast<double>(passes_) / static_cast<double>(steps_), "1");
    summary.add("passes_most", static_cast<double>(most_passes_), "1");
    summary.add("residual_worst", residual_worst_, "1");
}

}  // namespace gimdem::app

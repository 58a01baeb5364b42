// SPDX-License-Identifier: BSD-3-Clause
#include "app/RunTotals.hpp"

#include <algorithm>

namespace gimdem::app
{

void RunTotals::add_work(coupling::FluidState const& fluid, StepReport const& report)
{
    dem_.compute += report.timings.compute;
    dem_.mapping += report.timings.mapping;
    dem_.output += report.timings.output;
    if (fluid.pass == 0) cfd_.compute += fluid.previous.compute;
    exchange_ = fluid.exchange;
    client_waiting_ = fluid.waiting;
}

void RunTotals::add(coupling::Step const& step, StepReport const& report, std::int64_t particle_clips)
{
    ++steps_;
    last_time_ = step.time + step.dt;
    dem_steps_ += report.dem_steps;
    cell_clips_ += report.cell_clips;
    particle_clips_ = particle_clips;
    momentum_imbalance_ = std::max(momentum_imbalance_, report.momentum_imbalance);
    volume_imbalance_ = std::max(volume_imbalance_, report.volume_imbalance);
    void_fraction_min_ = std::min(void_fraction_min_, report.void_fraction_min);
    void_fraction_max_ = std::max(void_fraction_max_, report.void_fraction_max);
}

void RunTotals::add_progress(output::Summary& summary) const
{
    summary.add("simulated_time", last_time_ - first_time_, "s");
    summary.add("coupling_steps", static_cast<double>(steps_), "1");
    summary.add("dem_steps", static_cast<double>(dem_steps_), "1");
}

void RunTotals::add_balances(output::Summary& summary) const
{
    summary.add("momentum_imbalance", momentum_imbalance_, "1");
    summary.add("volume_imbalance", volume_imbalance_, "1");
    summary.add("void_fraction_min", void_fraction_min_, "1");
    summary.add("void_fraction_max", void_fraction_max_, "1");
    summary.add("void_fraction_clips", static_cast<double>(cell_clips_), "1");
    summary.add("void_fraction_clips_at_particles", static_cast<double>(particle_clips_), "1");
}

void RunTotals::add_shares(double wall, coupling::Schedule schedule, output::Summary& summary) const
{
    double const simulated = last_time_ - first_time_;
    if (simulated <= 0) return;
    bool const overlaps = schedule == coupling::Schedule::overlapped;
    auto const share = [&](double seconds) { return seconds / wall; };
    double const work = dem_.compute + dem_.mapping + dem_.output + exchange_ + (overlaps ? 0 : cfd_.compute);
    summary.add("wall_time", wall, "s");
    summary.add("wall_time_per_simulated_second", wall / simulated, "s");
    summary.add("share_dem", share(dem_.compute), "1");
    summary.add("share_mapping", share(dem_.mapping), "1");
    summary.add("share_cfd", share(cfd_.compute), "1");
    summary.add("share_exchange", share(exchange_), "1");
    summary.add("share_output", share(dem_.output), "1");
    summary.add("share_waiting", share(overlaps ? client_waiting_ : std::max(0.0, wall - work)), "1");
}

}  // namespace gimdem::app

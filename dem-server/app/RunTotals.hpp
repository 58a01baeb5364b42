// SPDX-License-Identifier: BSD-3-Clause
/// What a coupled run adds up from its first step to its last.
#pragma once

#include <cstdint>

#include "engine/CoupledEngine.hpp"
#include "gimdem/coupling/Server.hpp"
#include "output/Summary.hpp"

namespace gimdem::app
{

class RunTotals
{
public:
    /// The time at which the first step begins [s].
    void begin(double time) { first_time_ = time; }
    /// After each pass through a step: the time that it took.
    void add_work(coupling::FluidState const& fluid, StepReport const& report);
    /// After a step that stands.
    void add(coupling::Step const& step, StepReport const& report, std::int64_t particle_clips);

    std::int64_t steps() const { return steps_; }
    double first_time() const { return first_time_; }
    double last_time() const { return last_time_; }  ///< end of the last step [s]

    /// Steps and simulated time.
    void add_progress(output::Summary& summary) const;
    /// Balances and void fractions.
    void add_balances(output::Summary& summary) const;
    /// Where the wall time of the run went [s]; nothing without a step.
    void add_shares(double wall, coupling::Schedule schedule, output::Summary& summary) const;

private:
    std::int64_t steps_ = 0, dem_steps_ = 0, cell_clips_ = 0, particle_clips_ = 0;
    double first_time_ = 0, last_time_ = 0;
    double momentum_imbalance_ = 0, volume_imbalance_ = 0, void_fraction_min_ = 1, void_fraction_max_ = 0;
    coupling::Timings dem_, cfd_;
    double exchange_ = 0, client_waiting_ = 0;
};

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
/// coupling.csv, a row for each coupling step: who worked, who waited, what the schedule saves and what its lag costs.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/CoupledEngine.hpp"
#include "engine/LagMeter.hpp"
#include "gimdem/coupling/Server.hpp"
#include "output/OverlapMeter.hpp"
#include "output/Summary.hpp"
#include "output/TimeSeries.hpp"

namespace gimdem::app
{

class CouplingLog
{
public:
    CouplingLog(std::filesystem::path const& folder, PolyMesh const& mesh, coupling::Schedule schedule);

    /// The fluid of a step has come, after so long a wait [s]: the step before is over, its row is written. bytes: that
    /// the exchange has moved so far.
    void arrived(coupling::FluidState const& fluid, double waited, double bytes);
    /// The fluid of another pass through the same step has come, after so long a wait [s].
    void came_again(double waited) { running_->server_waiting += waited; }
    /// The solid has been computed.
    void answered(coupling::FluidState const& fluid, StepReport const& report, CoupledEngine const& engine);

    /// The run goes on from an earlier time [s]: rows from there on are written again.
    void rewind(double time);

    /// Figures of all steps but the last, of which the fluid solver never tells.
    void add_to(output::Summary& summary) const;

private:
    using Time = std::chrono::steady_clock::time_point;

    /// A step that is not over yet.
    struct Running
    {
        coupling::Step step;
        Time began;
        double client_waiting = 0;  ///< of the client so far, when the step began [s]
        double server_waiting = 0;  ///< between the passes [s]
        double exchange = 0;        ///< likewise [s]
        double bytes = 0;           ///< that had been moved then
        bool fluid_was_wanted = false;
        std::int64_t passes = 0;
        std::int64_t dem_steps = 0;  ///< of the last pass
        double dem = 0;              ///< of all passes [s]
        LagError lag;
    };

    void close(coupling::FluidState const& next, Time now, double waited, double bytes);

    bool iterates_;
    output::TimeSeries series_;
    output::OverlapMeter overlap_;
    LagMeter lag_;
    std::optional<Running> running_;
    double duration_ = 0, server_waiting_ = 0, client_waiting_ = 0,
           exchange_ = 0;           ///< sums of the steps that are over [s]
    LagError lag_sum_, lag_worst_;  ///< sums: times dt [s]
    std::int64_t steps_ = 0, whole_fluids_ = 0, passes_ = 0, most_passes_ = 0;
    double residual_worst_ = 0;
};

}  // namespace gimdem::app

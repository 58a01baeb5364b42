// SPDX-License-Identifier: BSD-3-Clause
/// What a run tells while it runs: trace and the status that `./gimdem status` asks for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/RunEvents.hpp"
#include "core/Case.hpp"
#include "engine/CoupledEngine.hpp"
#include "gimdem/coupling/Server.hpp"
#include "output/SpeedMeter.hpp"
#include "output/StepTrace.hpp"
#include "output/Summary.hpp"

namespace gimdem::app
{

/// Of a coupled run, once the client is there.
class RunObserver
{
public:
    RunObserver(Case const& settings, std::filesystem::path const& folder, coupling::Server& server, RunEvents& events,
                std::string const& client, coupling::Schedule schedule, output::TraceChoice const& trace);

    /// A phase before the first step: what is done, and how far it is [s].
    void phase(std::string const& activity, double time, double until);
    /// Before the particles of a step move.
    void begin_step(coupling::FluidState const& fluid);
    /// After the step's own records are written.
    void end_step(coupling::FluidState const& fluid, StepReport const& report, double particles);
    /// After the last one.
    void finish(output::Summary& summary);

private:
    void publish(coupling::FluidState const& fluid, StepReport const& report, double particles);
    void trace(coupling::FluidState const& fluid, StepReport const& report, double particles);

    coupling::Server& server_;
    RunEvents& events_;
    coupling::RunStatus status_;
    double until_;  ///< end of the run [s]
    std::optional<output::StepTrace> trace_;
    output::SpeedMeter speed_;
    double first_ = 0, computing_ = 0;  ///< the first step and this one began to compute, by clock_now() [s]
};

}  // namespace gimdem::app

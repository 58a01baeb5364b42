// SPDX-License-Identifier: BSD-3-Clause
/// All that a run writes: progress, time series, ParaView files, figures.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/BedSeries.hpp"
#include "app/RunTotals.hpp"
#include "core/Case.hpp"
#include "engine/CoupledEngine.hpp"
#include "gimdem/coupling/Server.hpp"
#include "output/Progress.hpp"
#include "output/ResultSeries.hpp"
#include "output/Summary.hpp"

namespace gimdem::app
{

class RunLog
{
public:
    RunLog(Case const& settings, std::filesystem::path folder, PolyMesh const& mesh, DemSystem const& system,
           coupling::ClientInfo const& client, coupling::Schedule schedule);

    /// Before a step: particles and fluid are both at step.time. Writes what is due. Returns the seconds it took.
    double sample(coupling::FluidState const& fluid, CoupledEngine const& engine);

    /// Will sample() write fields of all cells in the step that begins then [s]? It keeps to this answer.
    bool expects_frame(double time);
    /// The cells whose pressure and gradients it reads in every step.
    std::vector<std::int32_t> monitored_cells() const { return series_.monitored_cells(); }

    /// After a step, which may still be repeated: accept() or the next record() decides.
    void record(coupling::FluidState const& fluid, StepReport const& report, CoupledEngine const& engine);

    /// The run goes on from an earlier time [s]: rows and frames from there on are written again.
    void rewind(double time);
    /// The step that was recorded last stands; if there is none, nothing happens.
    void accept();

    /// The end, however it came: figures to summary.json and the terminal.
    void finish(double bytes);

    output::Progress& progress() { return progress_; }
    output::Summary& summary() { return summary_; }

private:
    /// A step that may still be repeated.
    struct Pending
    {
        coupling::Step step;
        StepReport report;
        double pressure_drop = 0;  ///< [Pa]
        std::int64_t particle_clips = 0;
    };

    bool is_due(double time, std::int64_t count, double interval) const;
    void write_frame(coupling::FluidState const& fluid, CoupledEngine const& engine);
    void add_weights(double inlet_area);
    double mean_diameter() const;
    double gas_weight() const;  ///< of the fluid in the whole mesh [N]

    Case const& settings_;
    std::filesystem::path folder_;
    PolyMesh const& mesh_;
    DemSystem const& system_;
    coupling::FluidProperties fluid_;
    coupling::Schedule schedule_;
    output::Progress progress_;
    output::Summary summary_;
    output::ResultSeries frames_;
    BedSeries series_;
    RunTotals totals_;
    std::int64_t rows_ = 0, frame_count_ = 0;
    std::optional<bool> frame_is_due_;  ///< in the next step, as expects_frame() told
    std::optional<Pending> pending_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
/// All that a run writes: progress, time series, ParaView files, figures.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/Case.hpp"
#include "engine/BedMonitors.hpp"
#include "engine/CoupledEngine.hpp"
#include "gimdem/coupling/Server.hpp"
#include "output/Progress.hpp"
#include "output/ResultSeries.hpp"
#include "output/Summary.hpp"
#include "output/TimeSeries.hpp"

namespace gimdem::app
{

class RunLog
{
public:
    RunLog(Case const& settings, std::filesystem::path folder, PolyMesh const& mesh, DemSystem const& system,
           coupling::ClientInfo const& client, coupling::Schedule schedule);

    /// Before a step: particles and fluid are both at step.time. Writes what is due. Returns the seconds it took.
    double sample(coupling::FluidState const& fluid, CoupledEngine const& engine);

    /// Will sample() write fields of all cells in the step that begins then? It keeps to this answer [s].
    bool expects_frame(double time);
    /// The cells whose pressure and gradients it reads in every step.
    std::vector<std::int32_t> monitored_cells() const;

    /// After a step.
    void record(coupling::FluidState const& fluid, StepReport const& report, CoupledEngine const& engine);

    /// The end, however it came: figures to summary.json and the terminal.
    void finish(double bytes);

    output::Progress& progress() { return progress_; }
    output::Summary& summary() { return summary_; }

private:
    /// Sums since the last row of the time series.
    struct Interval
    {
        double duration = 0;
        Vec3 drag = Vec3::Zero(), pressure = Vec3::Zero(), wall = Vec3::Zero();  ///< impulses [N s]
        double pressure_drop = 0;                                                ///< time integral [Pa s]
        double volume_imbalance = 0, momentum_imbalance = 0;                     ///< worst
        std::int64_t clips = 0;
    };

    void open_series(coupling::FluidState const& fluid);
    void write_row(coupling::FluidState const& fluid, CoupledEngine const& engine);
    void write_frame(coupling::FluidState const& fluid, CoupledEngine const& engine);
    bool is_frame_due(double time) const;
    double pressure_drop(coupling::FluidFields const& fluid) const;
    double mean_diameter() const;
    double gas_weight() const;  ///< of the fluid in the whole mesh [N]

    Case const& settings_;
    std::filesystem::path folder_;
    PolyMesh const& mesh_;
    DemSystem const& system_;
    coupling::FluidProperties fluid_;
    coupling::Schedule schedule_;
    Vec3 up_;
    std::vector<PlaneSection> planes_;
    coupling::Patch const* inlet_ = nullptr;
    coupling::Patch const* outlet_ = nullptr;
    output::Progress progress_;
    output::Summary summary_;
    output::ResultSeries frames_;
    std::optional<output::TimeSeries> series_;
    std::int64_t rows_ = 0, frame_count_ = 0;
    std::optional<bool> frame_is_due_;  ///< in the next step, as expects_frame() told
    std::int64_t whole_fluids_ = 0;     ///< steps in which cells of the fluid had to be asked for
    Interval interval_;
    Vec3 last_momentum_ = Vec3::Zero();

    // Over the whole run.
    std::chrono::steady_clock::time_point start_;
    std::int64_t steps_ = 0, dem_steps_ = 0, cell_clips_ = 0, particle_clips_ = 0;
    double first_time_ = 0, last_time_ = 0;
    double momentum_imbalance_ = 0, volume_imbalance_ = 0, void_fraction_min_ = 1, void_fraction_max_ = 0;
    coupling::Timings dem_, cfd_;
    double exchange_ = 0, client_waiting_ = 0;
};

}  // namespace gimdem::app

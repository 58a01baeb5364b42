// SPDX-License-Identifier: BSD-3-Clause
/// All that a run without a fluid writes: progress, time series, ParaView files, figures.
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

#include "core/Case.hpp"
#include "engine/Checkpoint.hpp"
#include "engine/DemSystem.hpp"
#include "mesh/PolyMesh.hpp"
#include "output/Progress.hpp"
#include "output/ResultSeries.hpp"
#include "output/Summary.hpp"
#include "output/TimeSeries.hpp"
#include "particles/Inlet.hpp"

namespace gimdem::app
{

class DemLog
{
public:
    DemLog(Case const& settings, std::filesystem::path const& folder, PolyMesh const& mesh, DemSystem const& system,
           std::vector<Inlet> const& inlets, RunPoint const& start);

    /// The particles as they are: a row of bed.csv, and the progress line.
    void write_row(RunPoint const& point);

    /// The same: a ParaView file.
    void write_frame(double time);

    /// The end, however it came: figures to summary.json and the terminal.
    void finish(RunPoint const& point);

    output::Progress& progress() { return progress_; }

private:
    Case const& settings_;
    std::filesystem::path folder_;
    PolyMesh const& mesh_;
    DemSystem const& system_;
    std::vector<Inlet> const& inlets_;
    RunPoint start_, last_row_;
    Vec3 up_;
    output::Progress progress_;
    output::Summary summary_;
    output::ResultSeries frames_;
    output::TimeSeries series_;
    std::chrono::steady_clock::time_point begin_, last_row_at_;
};

}  // namespace gimdem::app

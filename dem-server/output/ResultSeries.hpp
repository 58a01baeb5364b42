// SPDX-License-Identifier: BSD-3-Clause
/// The ParaView files of a run, opened as a time series by one file.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "output/VtkCells.hpp"
#include "output/VtkParticles.hpp"

namespace gimdem::output
{

/// Writes folder/particles/particles_000012.vtp, folder/cells/cells_000012.vtu, ... and folder/results.pvd, which lists
/// them with their times. The list is replaced atomically after each frame, so it can be opened during the run.
class ResultSeries
{
public:
    /// Creates the folders; an older series in them is forgotten once the first frame is written.
    ResultSeries(std::filesystem::path folder, coupling::Mesh const& mesh);

    /// Go on with the series that is in the folder: keep its frames before `time` [s], drop the later ones.
    /// @returns the number of frames kept, 0 where there is no series.
    int resume(double time);

    /// Write one frame at `time` [s].
    void write(double time, ParticleFrame const& particles, std::span<CellField const> fields);

    /// The file to open in ParaView.
    std::filesystem::path index() const { return folder_ / "results.pvd"; }

    /// Number of frames that the index lists.
    int frame_count() const { return static_cast<int>(times_.size()); }

private:
    void write_index() const;

    std::filesystem::path folder_;
    VtkCells cells_;
    std::vector<double> times_;  ///< of the frames 0, 1, ... [s]
};

}  // namespace gimdem::output

// SPDX-License-Identifier: BSD-3-Clause
/// The cells in which a coupling step reads the fluid, told to the client one step ahead: only they travel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gimdem/coupling/CellRuns.hpp"
#include "gimdem/coupling/Types.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// Loads are computed once, where the particles are when the step begins: those cells are known exactly. The drag that
/// the fluid gets back is computed with the velocity where the particles are when the step ends, (C.7): these cells
/// are guessed, as those that have drag now and two layers around them, and looked at before they are read.
class FluidCoverage
{
public:
    explicit FluidCoverage(PolyMesh const& mesh);

    /// Cells whose pressure and gradients are read whatever the particles do, for monitors.
    void monitor(std::span<std::int32_t const> cells);

    /// Chooses the cells of the next step, from the cell of each particle and where has_drag, shape=(n_cells,), is not
    /// 0.
    void look_ahead(std::span<std::int32_t const> cell_of, std::span<std::uint8_t const> has_drag);

    /// Were all these cells chosen for what particles read?
    bool has_loads(std::span<std::int32_t const> cells) const;
    /// Was the velocity chosen wherever has_drag is not 0?
    bool has_velocity(std::span<std::uint8_t const> has_drag) const;

    /// What was chosen, by fields. whole_velocity: the velocity in all cells, so that no guess can fail.
    std::vector<coupling::NeededCells> needed(bool whole_velocity);

private:
    void grow(std::vector<std::int32_t>& edge);

    PolyMesh const& mesh_;
    std::vector<std::uint8_t> monitored_, loads_, velocity_;  ///< flags, shape=(n_cells,)
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Where the weights of each particle are: consecutive rows for the particles of a cell, cell after cell.
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "exec/Sort.hpp"
#include "mapping/Method.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

struct RowLayout
{
    exec::Buffer<std::int32_t> occupied;  ///< cells that hold particles, in the given order
    exec::Buffer<std::int64_t> first;     ///< place of the first weight of a cell that holds particles; by cell
    std::int64_t weight_count = 0;

    /// For the particles of the first groups, one for each cell. `order`: of all cells.
    void lay_out(CellRows const& candidates, exec::Groups const& by_cell, exec::Buffer<std::int32_t> const& order)
    {
        std::int64_t const cell_count = order.size();
        first.resize(cell_count);
        occupied.resize(cell_count);
        std::int64_t occupied_count = 0;
        for (std::int32_t const c : order.host())
        {
            occupied[occupied_count] = c;
            occupied_count += by_cell.offsets[c + 1] > by_cell.offsets[c];
        }
        weight_count = 0;
        for (std::int64_t c = 0; c < cell_count; ++c)
        {
            std::int64_t const particles = by_cell.offsets[c + 1] - by_cell.offsets[c];
            first[c] = weight_count;
            weight_count += particles * (candidates.offsets[c + 1] - candidates.offsets[c]);
        }
        occupied.resize(occupied_count);
    }

    WeightRows rows(CellRows const& candidates, exec::Groups const& by_cell) const
    {
        return {candidates.offsets.view().data, candidates.cells.view().data, by_cell.offsets.view().data,
                by_cell.members.view().data, first.view().data};
    }
};

}  // namespace gimdem

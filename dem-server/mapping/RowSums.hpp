// SPDX-License-Identifier: BSD-3-Clause
/// Sums of volume and momentum into cells with rows of weights: each occupied cell sums what its particles give to each
/// of its candidates, then each cell sums what it got. In a fixed order, without atomics.
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "mapping/Method.hpp"
#include "mapping/Share.hpp"
#include "mesh/PolyMesh.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// What is summed.
struct WeightedParticles
{
    WeightRows rows;
    double const* weights;
    Quad const* position;     ///< [m], w: radius
    Impulse const* impulses;  ///< null: volumes only
};

class RowSums
{
public:
    /// Sees to room for the shares of these cells.
    void lay_out(CellRows const& layers, exec::Buffer<std::int32_t> const& occupied,
                 exec::Buffer<std::int32_t> const& cell_order);

    /// `reverse_slot`: for entry k of the layers, place of the row's cell in the row of cells[k].
    void sum(exec::Execution const& execution, WeightedParticles const& of,
             exec::Buffer<std::int32_t> const& reverse_slot, CellSums& sums);

private:
    void find_receivers(CellRows const& layers, exec::Buffer<std::int32_t> const& cell_order);

    std::int32_t cell_count_ = 0;
    exec::Buffer<std::int32_t> occupied_;     ///< cells that hold particles
    exec::Buffer<std::int32_t> receivers_;    ///< cells that may get a share
    exec::Buffer<std::uint8_t> receives_;     ///< 1 for those
    exec::Buffer<std::int64_t> first_share_;  ///< -1 for a cell without particles; a multiple of eight
    exec::Buffer<Quad> drag_shares_;          ///< as CellSums::drag
    exec::Buffer<double> volume_shares_;      ///< [m^3]
};

}  // namespace gimdem

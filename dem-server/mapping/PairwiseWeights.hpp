// SPDX-License-Identifier: BSD-3-Clause
/// Weights (G.8) and sums with them where each pair of a particle and a cell is computed by itself, by a law of
/// PairLaws.hpp. No weight is kept: a device computes one faster than it reads one.
#pragma once

#include <cstdint>

#include "mapping/Share.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// The cells around each cell: entry e of layer_cells is a candidate of the particles in cell row_of[e].
struct LayerView
{
    std::int32_t const* offsets;
    std::int32_t const* cells;
    std::int32_t const* row_of;
    std::int32_t const* reverse_slot;  ///< place of the row's cell in the row of cells[e]
};

/// 1 / (sum of a particle's shares); 0 where all underflow and the own cell takes all.
template <class Law>
struct WeightTotalKernel
{
    Law law;
    LayerView layers;
    Quad const* position;
    std::int32_t const* cell_of;
    double* per_total;

    GIMDEM_HD void operator()(std::int64_t p) const
    {
        Quad const x = position[p];
        std::int32_t const c = cell_of[p];
        double total = 0;
        for (std::int32_t e = layers.offsets[c]; e < layers.offsets[c + 1]; ++e)
            total += law(x, c, layers.cells[e]);
        per_total[p] = total > 0 ? 1 / total : 0;
    }
};

/// What the particles of a cell give to one of their candidates, entry e of the layers.
template <class Law>
struct ShareKernel
{
    Law law;
    LayerView layers;
    Quad const* position;
    Impulse const* impulses;  ///< null: volumes only
    double const* per_total;
    std::int32_t const* particle_offsets;  ///< particles of cell c are members[particle_offsets[c] ...)
    std::int32_t const* members;
    Share* shares;

    GIMDEM_HD void operator()(std::int64_t e) const
    {
        std::int32_t const c = layers.row_of[e];
        bool const own = e == layers.offsets[c];
        Share sum{{0, 0, 0, 0}, 0};
        for (std::int32_t m = particle_offsets[c]; m < particle_offsets[c + 1]; ++m)
        {
            std::int32_t const p = members[m];
            Quad const x = position[p];
            double const scale = per_total[p];
            double const weight = scale > 0 ? law(x, c, layers.cells[e]) * scale : (own ? 1.0 : 0.0);
            Quad const drag = impulses == nullptr ? Quad{0, 0, 0, 0} : impulses[p].drag;
            sum.add(weight, {drag, sphere_volume(x.w)});
        }
        shares[e] = sum;
    }
};

/// Sums of one cell: its shares of the particles in the cells around it.
struct ShareSumKernel
{
    LayerView layers;
    Share const* shares;
    Share* sums;

    GIMDEM_HD void operator()(std::int64_t c) const
    {
        Share sum{{0, 0, 0, 0}, 0};
        for (std::int32_t e = layers.offsets[c]; e < layers.offsets[c + 1]; ++e)
            sum.add(1, shares[layers.offsets[layers.cells[e]] + layers.reverse_slot[e]]);
        sums[c] = sum;
    }
};

}  // namespace gimdem

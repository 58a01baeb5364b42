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

/// A law whose shares depend on the least of the levels of a particle's candidates: law.level(particle, cell).
template <class Law>
concept Compares = requires(Law const& law, Quad const& x)
{
    law.level(x, 0);
};

/// What the shares of one particle have in common.
struct ParticleTotal
{
    double per_total;  ///< 1 / (sum of its shares); 0 where all underflow and the own cell takes all
    double least;      ///< level of its candidates, for a law that compares
};

template <class Law>
struct WeightTotalKernel
{
    Law law;
    LayerView layers;
    Quad const* position;
    std::int32_t const* cell_of;
    ParticleTotal* totals;

    GIMDEM_HD void operator()(std::int64_t p) const
    {
        Quad const x = position[p];
        std::int32_t const c = cell_of[p];
        double total = 0, least = 1e300;
        if constexpr (Compares<Law>)
            for (std::int32_t e = layers.offsets[c]; e < layers.offsets[c + 1]; ++e)
            {
                double const level = law.level(x, layers.cells[e]);
                least = level < least ? level : least;
            }
        for (std::int32_t e = layers.offsets[c]; e < layers.offsets[c + 1]; ++e)
            total += share_of(law, x, c, layers.cells[e], least);
        totals[p] = {total > 0 ? 1 / total : 0, least};
    }

    /// Before it is normalised.
    GIMDEM_HD static double share_of(Law const& law, Quad const& x, std::int32_t own, std::int32_t cell, double least)
    {
        if constexpr (Compares<Law>)
            return law(x, own, cell, least);
        else
            return law(x, own, cell);
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
    ParticleTotal const* totals;
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
            ParticleTotal const of = totals[p];
            double const weight =
                of.per_total > 0 ? WeightTotalKernel<Law>::share_of(law, x, c, layers.cells[e], of.least) * of.per_total
                                 : (own ? 1.0 : 0.0);
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

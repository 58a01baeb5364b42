// SPDX-License-Identifier: BSD-3-Clause
/// Particles by size: each level holds the radii within a factor of two in a grid of its own, theory.md (D.73), so that
/// small particles do not crowd the cells of large ones.
#pragma once

#include <cstdint>

#include "exec/Execution.hpp"
#include "particles/ParticleState.hpp"
#include "search/CellGrid.hpp"
#include "search/Domain.hpp"

namespace gimdem
{

/// What is known of a set of particles before they are sorted.
struct Extent
{
    Constant3 low, high;     ///< corners of the box of all centres [m]
    double largest_radius;   ///< [m]
    double smallest_radius;  ///< [m]

    /// Throws UserError for a position that is not finite.
    static Extent of(exec::Execution const& execution, ParticleState const& particles);
};

/// How many particles there are between two halvings of the largest radius, and how large they are.
struct SizeCensus
{
    static constexpr int most = 8;  ///< radii below 1/128 of the largest are counted together

    std::int64_t count[most]{};
    double largest[most]{};  ///< [m]

    static SizeCensus of(exec::Execution const& execution, ParticleState const& particles, Extent const& extent);
};

struct SizeLevel
{
    CellGrid grid;                    ///< cells of twice the largest radius + skin
    std::int32_t first_cell = 0;      ///< where the grid's cells begin in the numbering of all levels' cells
    std::int32_t first_particle = 0;  ///< the same for particles sorted by level
    double largest_radius = 0;        ///< [m]
};

/// The levels that hold particles, finest first; sorted by them, every pair of two levels has its finer member first.
struct SizeLevels
{
    static constexpr int most = SizeCensus::most;

    SizeLevel level[most];
    int count = 0;
    std::int32_t cell_count = 0;   ///< of all levels
    double largest_radius = 0;     ///< [m]
    std::int8_t level_of[most]{};  ///< level of the radii in (largest / 2^(k + 1), largest / 2^k]

    /// Levels for cells of `skin` [m] beyond contact. The grids cover `extent`, or the box of a periodic domain.
    static SizeLevels of(exec::Execution const& execution, ParticleState const& particles, Extent const& extent,
                         double skin, Domain const& domain);
    static SizeLevels of(SizeCensus const& census, Extent const& extent, double skin, Domain const& domain);

    /// k of the radii in (largest / 2^(k + 1), largest / 2^k].
    GIMDEM_HD static int halvings(double radius, double largest)
    {
        int k = 0;
        for (double bound = largest / 2; radius <= bound && k + 1 < most; bound /= 2)
            ++k;
        return k;
    }

    /// Number among all levels' cells of the cell of a particle.
    GIMDEM_HD std::int32_t cell_of(Quad const& particle) const
    {
        SizeLevel const& own = level[level_of[halvings(particle.w, largest_radius)]];
        return own.first_cell + own.grid.cell_of(particle.xyz());
    }

    /// Level of a particle, once they are sorted.
    GIMDEM_HD int level_of_particle(std::int64_t i) const
    {
        int l = 0;
        while (l + 1 < count && i >= level[l + 1].first_particle)
            ++l;
        return l;
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Which particles to look at for the pairs of one: those of its own level in its cell and the cells around, and those
/// of coarser levels in the cells that its reach touches, theory.md (D.74).
#pragma once

#include <cstdint>

#include "search/SizeLevels.hpp"

namespace gimdem
{

/// Cells along one axis: one run, or two where a run goes round a periodic border. Rising.
struct CellRuns
{
    std::int32_t begin[2]{}, end[2]{};
    int count = 1;

    /// Cells low ... high of n, of which those below 0 or from n on are met on the other side.
    GIMDEM_HD static CellRuns round(std::int32_t low, std::int32_t high, std::int32_t n)
    {
        if (high - low + 1 >= n) return {{0, 0}, {n, 0}, 1};
        if (low < 0) return {{0, low + n}, {high + 1, n}, 2};
        if (high >= n) return {{0, low}, {high + 1 - n, n}, 2};
        return {{low, 0}, {high + 1, 0}, 1};
    }

    /// Cells that hold the points from `low` to `high`, measured from the grid's origin [m]; `period` [m], 0: open. No
    /// point is farther outside a periodic axis than a cell is long.
    GIMDEM_HD static CellRuns between(double low, double high, CellGrid const& grid, std::int32_t n, double period)
    {
        if (!(period > 0)) return {{grid.along(low, n), 0}, {grid.along(high, n) + 1, 0}, 1};
        return round(low < 0 ? -1 : grid.along(low, n), high < period ? grid.along(high, n) : n, n);
    }
};

/// Visits, in rising order, every candidate j > i. Particles are sorted by cell, and cells along x are consecutive, so
/// that a row of cells is one range of particles.
template <bool periodic>
struct CandidateVisitor
{
    SizeLevels levels;
    Constant3 period;  ///< [m], 0: open
    double skin;       ///< [m]
    Quad const* position;
    std::int32_t const* cell_start;
    std::int32_t const* cell_of;

    template <class Visit>
    GIMDEM_HD void operator()(std::int64_t i, Visit&& visit) const
    {
        for_each_range(i,
                       [&](std::int64_t begin, std::int64_t end)
                       {
                           for (std::int64_t j = begin; j < end; ++j)
                               visit(j);
                       });
    }

    /// Number of candidates of i.
    GIMDEM_HD std::int64_t count(std::int64_t i) const
    {
        std::int64_t sum = 0;
        for_each_range(i, [&](std::int64_t begin, std::int64_t end) { sum += begin < end ? end - begin : 0; });
        return sum;
    }

private:
    template <class Visit>
    GIMDEM_HD void for_each_range(std::int64_t i, Visit&& visit) const
    {
        int const own = levels.level_of_particle(i);
        if constexpr (periodic)
            look_round(i, levels.level[own], visit);
        else
            look_ahead(i, levels.level[own], visit);
        for (int l = own + 1; l < levels.count; ++l)
            look_into(i, levels.level[l], visit);
    }

    /// The cell of i and the cells around it that come after.
    template <class Visit>
    GIMDEM_HD void look_ahead(std::int64_t i, SizeLevel const& level, Visit&& visit) const
    {
        CellGrid const& grid = level.grid;
        std::int32_t const cell = cell_of[i] - level.first_cell;
        std::int32_t const x = cell % grid.nx;
        std::int32_t const y = cell / grid.nx % grid.ny;
        std::int32_t const z = cell / grid.nx / grid.ny;
        std::int32_t const x0 = x > 0 ? x - 1 : 0;
        std::int32_t const x1 = x + 1 < grid.nx ? x + 1 : x;
        for (std::int32_t dz = 0; dz <= 1; ++dz)
            for (std::int32_t dy = dz == 0 ? 0 : -1; dy <= 1; ++dy)
            {
                if (z + dz >= grid.nz || y + dy < 0 || y + dy >= grid.ny) continue;
                std::int32_t const row = level.first_cell + ((z + dz) * grid.ny + y + dy) * grid.nx;
                visit(dz == 0 && dy == 0 ? i + 1 : cell_start[row + x0], cell_start[row + x1 + 1]);
            }
    }

    /// The same where the cells around may lie on the other side: all of them, cut to what comes after i.
    template <class Visit>
    GIMDEM_HD void look_round(std::int64_t i, SizeLevel const& level, Visit&& visit) const
    {
        CellGrid const& grid = level.grid;
        std::int32_t const cell = cell_of[i] - level.first_cell;
        auto const around = [](std::int32_t at, std::int32_t n, double length) -> CellRuns
        {
            if (length > 0) return CellRuns::round(at - 1, at + 1, n);
            return {{at > 0 ? at - 1 : 0, 0}, {at + 1 < n ? at + 2 : n, 0}, 1};
        };
        visit_block(level, around(cell % grid.nx, grid.nx, period.x),
                    around(cell / grid.nx % grid.ny, grid.ny, period.y),
                    around(cell / grid.nx / grid.ny, grid.nz, period.z), i + 1, visit);
    }

    /// The cells of a coarser level that may hold the centre of a particle near i.
    template <class Visit>
    GIMDEM_HD void look_into(std::int64_t i, SizeLevel const& level, Visit&& visit) const
    {
        // A little farther than the pairs are, for the rounding of positions.
        double const reach = (1 + 1e-9) * (position[i].w + level.largest_radius + skin);
        auto const near = [&](double x, double origin, std::int32_t n, double length)
        { return CellRuns::between(x - origin - reach, x - origin + reach, level.grid, n, length); };
        CellGrid const& grid = level.grid;
        visit_block(level, near(position[i].x, grid.origin.x, grid.nx, period.x),
                    near(position[i].y, grid.origin.y, grid.ny, period.y),
                    near(position[i].z, grid.origin.z, grid.nz, period.z), 0, visit);
    }

    /// The particles from number `least` on in a block of cells.
    template <class Visit>
    GIMDEM_HD void visit_block(SizeLevel const& level, CellRuns const& x, CellRuns const& y, CellRuns const& z,
                               std::int64_t least, Visit&& visit) const
    {
        for (int rz = 0; rz < z.count; ++rz)
            for (std::int32_t cz = z.begin[rz]; cz < z.end[rz]; ++cz)
                for (int ry = 0; ry < y.count; ++ry)
                    for (std::int32_t cy = y.begin[ry]; cy < y.end[ry]; ++cy)
                        for (int rx = 0; rx < x.count; ++rx)
                        {
                            std::int32_t const row = level.first_cell + (cz * level.grid.ny + cy) * level.grid.nx;
                            std::int64_t const begin = cell_start[row + x.begin[rx]];
                            visit(begin < least ? least : begin, cell_start[row + x.end[rx]]);
                        }
    }
};

}  // namespace gimdem

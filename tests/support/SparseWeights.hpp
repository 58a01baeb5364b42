// SPDX-License-Identifier: BSD-3-Clause
/// Weights of particles as lists of cells, whatever rows a method keeps them in.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mapping/Mapper.hpp"

namespace gimdem::test
{

struct CellWeight
{
    std::int32_t cell;
    double weight;

    auto operator<=>(CellWeight const&) const = default;
};

/// Weights of one particle that are not zero, by rising cell.
using SparseRow = std::vector<CellWeight>;

/// A row for each particle, of what the mapper last computed.
inline std::vector<SparseRow> sparse_rows(Mapper const& mapper)
{
    CellRows const& layers = mapper.layers();
    auto const& cell_of = mapper.cell_of();
    std::vector<std::int64_t> order(static_cast<std::size_t>(cell_of.size()));
    for (std::size_t p = 0; p < order.size(); ++p)
        order[p] = static_cast<std::int64_t>(p);
    std::ranges::stable_sort(order, {}, [&](std::int64_t p) { return cell_of[p]; });
    std::vector<SparseRow> rows(order.size());
    std::int64_t at = 0;
    for (std::int64_t const p : order)
    {
        SparseRow& row = rows[static_cast<std::size_t>(p)];
        for (std::int32_t k = layers.offsets[cell_of[p]]; k < layers.offsets[cell_of[p] + 1]; ++k, ++at)
            if (mapper.weights()[at] != 0) row.push_back({layers.cells[k], mapper.weights()[at]});
        std::ranges::sort(row);
    }
    return rows;
}

/// Visits what two rows give to each cell: visit(cell, of the one, of the other).
template <class Visit>
void for_each_cell_of(SparseRow const& one, SparseRow const& other, Visit visit)
{
    auto a = one.begin(), b = other.begin();
    while (a != one.end() || b != other.end())
    {
        bool const take_a = b == other.end() || (a != one.end() && a->cell <= b->cell);
        bool const take_b = a == one.end() || (b != other.end() && b->cell <= a->cell);
        std::int32_t const cell = take_a ? a->cell : b->cell;
        visit(cell, take_a ? (a++)->weight : 0.0, take_b ? (b++)->weight : 0.0);
    }
}

/// Share of a particle that two rows give to different cells, theory.md (G.30): half the sum of the differences.
inline double share_in_wrong_cells(SparseRow const& row, SparseRow const& exact)
{
    double distance = 0;
    for_each_cell_of(row, exact, [&](std::int32_t, double a, double b) { distance += std::abs(a - b); });
    return distance / 2;
}

}  // namespace gimdem::test

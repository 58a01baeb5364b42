// SPDX-License-Identifier: BSD-3-Clause
/// How far a mapping method is from the exact overlap, on any mesh.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "Mapped.hpp"

namespace gimdem::test
{

/// Weights of every particle as pairs of a cell and what it gets.
using SparseWeights = std::vector<std::vector<std::pair<std::int32_t, double>>>;

inline SparseWeights weights_of_all(PolyMesh const& mesh, std::string_view name, std::vector<Sphere> const& spheres)
{
    Mapped const m(mesh, method(name), spheres);
    CellRows const& rows = m.mapper.layers();
    std::vector<std::vector<std::size_t>> members(static_cast<std::size_t>(mesh.cell_count()));
    for (std::size_t p = 0; p < spheres.size(); ++p)
        members[static_cast<std::size_t>(m.mapper.cell_of()[static_cast<std::int64_t>(p)])].push_back(p);
    SparseWeights weights(spheres.size());
    std::int64_t next = 0;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        for (std::size_t const p : members[static_cast<std::size_t>(c)])
            for (std::int32_t k = rows.offsets[c]; k < rows.offsets[c + 1]; ++k, ++next)
                if (double const w = m.mapper.weights()[next]; w != 0) weights[p].emplace_back(rows.cells[k], w);
    return weights;
}

/// Share of the particles' volume that one of two has in other cells than the other: half the sum of |w - w'|.
inline double share_apart(std::int32_t cell_count, SparseWeights const& a, SparseWeights const& b)
{
    std::vector<double> apart(static_cast<std::size_t>(cell_count), 0.0);
    double sum = 0;
    for (std::size_t p = 0; p < a.size(); ++p)
    {
        for (auto const& [cell, w] : a[p])
            apart[static_cast<std::size_t>(cell)] += w;
        for (auto const& [cell, w] : b[p])
            apart[static_cast<std::size_t>(cell)] -= w;
        for (auto const* const row : {&a[p], &b[p]})
            for (auto const& [cell, w] : *row)
                sum += std::abs(std::exchange(apart[static_cast<std::size_t>(cell)], 0.0));
    }
    return sum / 2 / static_cast<double>(a.size());
}

/// Solid fraction of every cell, for spheres of one size.
inline std::vector<double> solid_fractions(PolyMesh const& mesh, SparseWeights const& weights, double radius)
{
    std::vector<double> fractions(static_cast<std::size_t>(mesh.cell_count()), 0.0);
    for (auto const& row : weights)
        for (auto const& [cell, w] : row)
            fractions[static_cast<std::size_t>(cell)] += w * sphere_volume(radius) / mesh.volume(cell);
    return fractions;
}

}  // namespace gimdem::test

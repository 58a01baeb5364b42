// SPDX-License-Identifier: BSD-3-Clause
/// Whether a sphere would overlap those that are there: spheres in the cells of a grid, one list a cell.
#pragma once

#include <cstdint>
#include <vector>

#include "exec/Vector.hpp"
#include "search/CellGrid.hpp"

namespace gimdem
{

class OverlapGrid
{
public:
    /// For spheres of up to `largest_radius` [m]; the box is where most of them are, spheres outside belong to it too.
    OverlapGrid(Vec3 const& low, Vec3 const& high, double largest_radius)
        : grid_(CellGrid::over(low, high, 2 * largest_radius, 4'000'000)),
          largest_radius_(largest_radius),
          newest_(static_cast<std::size_t>(grid_.count()), -1)
    {
    }

    void add(Vec3 const& x, double radius)
    {
        std::int32_t& newest = newest_[static_cast<std::size_t>(grid_.cell_of(x))];
        older_.push_back(newest);
        spheres_.push_back(Quad::of(x, radius));
        newest = static_cast<std::int32_t>(spheres_.size()) - 1;
    }

    /// True where a sphere of `radius` at x would overlap one that was added.
    bool overlaps(Vec3 const& x, double radius) const
    {
        Vec3 const reach = Vec3::Constant(radius + largest_radius_);
        std::int32_t const first = grid_.cell_of(x - reach), last = grid_.cell_of(x + reach);
        auto const along = [&](std::int32_t cell)
        { return Eigen::Vector3i(cell % grid_.nx, cell / grid_.nx % grid_.ny, cell / grid_.nx / grid_.ny); };
        Eigen::Vector3i const a = along(first), b = along(last);
        for (int z = a.z(); z <= b.z(); ++z)
            for (int y = a.y(); y <= b.y(); ++y)
                for (int k = a.x(); k <= b.x(); ++k)
                    if (cell_overlaps((z * grid_.ny + y) * grid_.nx + k, x, radius)) return true;
        return false;
    }

private:
    bool cell_overlaps(std::int32_t cell, Vec3 const& x, double radius) const
    {
        for (std::int32_t s = newest_[static_cast<std::size_t>(cell)]; s >= 0; s = older_[static_cast<std::size_t>(s)])
        {
            Quad const& other = spheres_[static_cast<std::size_t>(s)];
            double const apart = radius + other.w;
            if ((x - other.xyz()).squaredNorm() < apart * apart) return true;
        }
        return false;
    }

    CellGrid grid_;
    double largest_radius_;
    std::vector<std::int32_t> newest_, older_;
    std::vector<Quad> spheres_;  ///< w: radius [m]
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "walls/TriangleBins.hpp"

#include <algorithm>
#include <cmath>

#include "exec/Sort.hpp"

namespace gimdem
{

namespace
{

constexpr std::int64_t most_boxes = 4'000'000;

struct Box
{
    Vec3 low, high;
};

Box box_of(WallTriangle const& t)
{
    Vec3 const a = t.a.xyz(), b = t.b.xyz(), c = t.c.xyz();
    return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

/// Calls visit(cell) for the boxes of a grid within `reach` of a triangle: those that its bounding box covers, less
/// those on either side of its plane.
template <class Visit>
void visit_cells(CellGrid const& grid, WallTriangle const& triangle, double reach, Visit&& visit)
{
    Box const box = box_of(triangle);
    std::int32_t const first = grid.cell_of(box.low - Vec3::Constant(reach));
    std::int32_t const last = grid.cell_of(box.high + Vec3::Constant(reach));
    auto const x = [&](std::int32_t cell) { return cell % grid.nx; };
    auto const y = [&](std::int32_t cell) { return cell / grid.nx % grid.ny; };
    auto const z = [&](std::int32_t cell) { return cell / grid.nx / grid.ny; };
    Vec3 const a = triangle.a.xyz();
    Vec3 const normal = (triangle.b.xyz() - a).cross(triangle.c.xyz() - a).stableNormalized();
    // A little more than half a box's diagonal, against rounding.
    double const farthest = reach + 0.87 * grid.cell_size;
    for (std::int32_t cz = z(first); cz <= z(last); ++cz)
        for (std::int32_t cy = y(first); cy <= y(last); ++cy)
            for (std::int32_t cx = x(first); cx <= x(last); ++cx)
            {
                Vec3 const centre = grid.origin.vec() + grid.cell_size * Vec3(cx + 0.5, cy + 0.5, cz + 0.5);
                if (std::abs(normal.dot(centre - a)) <= farthest) visit((cz * grid.ny + cy) * grid.nx + cx);
            }
}

}  // namespace

TriangleBins::TriangleBins(std::span<WallTriangle const> triangles, double reach)
{
    fit_grid(triangles, reach);
    auto const visit = [&](auto&& action)
    {
        for (std::size_t t = 0; t < triangles.size(); ++t)
            visit_cells(grid_, triangles[t], reach,
                        [&](std::int32_t cell)
                        { action(static_cast<std::size_t>(cell), static_cast<std::int32_t>(t)); });
    };
    offsets_.assign(static_cast<std::size_t>(grid_.count()) + 1, 0);
    visit([&](std::size_t cell, std::int32_t) { ++offsets_[cell]; });
    members_.resize(static_cast<std::size_t>(exec::exclusive_scan(offsets_)));
    std::vector<std::int32_t> next = offsets_;
    visit([&](std::size_t cell, std::int32_t t) { members_[static_cast<std::size_t>(next[cell]++)] = t; });
}

/// Boxes as large as what is within reach, but not much larger than triangles that are smaller than that.
void TriangleBins::fit_grid(std::span<WallTriangle const> triangles, double reach)
{
    Box all = box_of(triangles.front());
    double size = 0;
    for (WallTriangle const& triangle : triangles)
    {
        Box const box = box_of(triangle);
        all = {all.low.cwiseMin(box.low), all.high.cwiseMax(box.high)};
        size += (box.high - box.low).maxCoeff() / static_cast<double>(triangles.size());
    }
    low_ = all.low - Vec3::Constant(reach);
    high_ = all.high + Vec3::Constant(reach);
    grid_ = CellGrid::over(low_, high_, std::clamp(size, reach, 2 * reach), most_boxes);
}

}  // namespace gimdem

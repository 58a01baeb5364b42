// SPDX-License-Identifier: BSD-3-Clause
/// A triangulated surface as a file gives it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exec/Vector.hpp"

namespace gimdem
{

/// Triangles keep the order of their file; corners at the same place are one point.
struct SurfaceMesh
{
    using Triangle = std::array<std::int32_t, 3>;

    std::vector<Vec3> points;         ///< [m]
    std::vector<Triangle> triangles;  ///< anticlockwise seen from outside

    Vec3 point(std::size_t triangle, int corner) const
    {
        return points[static_cast<std::size_t>(triangles[triangle][static_cast<std::size_t>(corner)])];
    }
    /// Twice the area, along the normal [m^2].
    Vec3 area_vector(std::size_t t) const { return (point(t, 1) - point(t, 0)).cross(point(t, 2) - point(t, 0)); }
};

/// One use of an edge: side `side` of a triangle runs from its corner `side` to the next.
struct EdgeUse
{
    std::int32_t low, high;  ///< its two points, low < high
    std::int32_t triangle;
    std::int8_t side;  ///< 0, 1, 2
    bool forward;      ///< from low to high

    bool same_edge(EdgeUse const& other) const { return low == other.low && high == other.high; }
};

/// All edge uses, those of one edge next to each other, by rising triangle.
std::vector<EdgeUse> edges_of(SurfaceMesh const& surface);

/// Calls visit(first, end) for the uses of each edge.
template <class Visit>
void for_each_edge(std::vector<EdgeUse> const& uses, Visit&& visit)
{
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
    {
        while (end < uses.size() && uses[end].same_edge(uses[begin]))
            ++end;
        visit(begin, end);
    }
}

}  // namespace gimdem

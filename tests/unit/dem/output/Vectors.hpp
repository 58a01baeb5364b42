// SPDX-License-Identifier: BSD-3-Clause
/// Just enough geometry to judge cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace gimdem::test
{

using Vector = std::array<double, 3>;

inline Vector operator-(Vector const& a, Vector const& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(Vector const& a, Vector const& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector cross(Vector const& a, Vector const& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Point number `i` of shape=(n, 3).
template <class Number, class Index>
Vector point_at(std::vector<Number> const& points, Index i)
{
    auto const at = 3 * static_cast<std::size_t>(i);
    return {points[at], points[at + 1], points[at + 2]};
}

/// Volume under a polygon as seen from the origin; the sum over a closed surface with outward normals is its volume.
template <class Number, class Index>
double volume_under(std::vector<Index> const& face, std::vector<Number> const& points)
{
    double volume = 0;
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
        volume += dot(point_at(points, face[0]), cross(point_at(points, face[i]), point_at(points, face[i + 1]))) / 6;
    return volume;
}

}  // namespace gimdem::test

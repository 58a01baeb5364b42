// SPDX-License-Identifier: BSD-3-Clause
/// Closest points: the geometry of walls.
#pragma once

#include "exec/Vector.hpp"

namespace gimdem
{

/// The point of segment ab that is closest to x.
GIMDEM_HD inline Vec3 closest_on_segment(Vec3 const& a, Vec3 const& b, Vec3 const& x)
{
    Vec3 const ab = b - a;
    double const length2 = ab.squaredNorm();
    double const t = length2 > 0 ? (x - a).dot(ab) / length2 : 0;
    return t <= 0 ? a : (t >= 1 ? b : Vec3(a + t * ab));
}

/// Closest point of a triangle and whether it lies in its interior.
struct ClosestPoint
{
    Vec3 point;
    bool interior;
};

/// Closest point of triangle abc to x: its projection where that is inside, else the best of the three edges.
GIMDEM_HD inline ClosestPoint closest_on_triangle(Vec3 const& a, Vec3 const& b, Vec3 const& c, Vec3 const& x)
{
    Vec3 const normal = (b - a).cross(c - a);
    double const area2 = normal.squaredNorm();
    bool const inside = area2 > 0 && (b - a).cross(x - a).dot(normal) >= 0 && (c - b).cross(x - b).dot(normal) >= 0 &&
                        (a - c).cross(x - c).dot(normal) >= 0;
    if (inside) return {x - (x - a).dot(normal) / area2 * normal, true};

    Vec3 best = closest_on_segment(a, b, x);
    for (Vec3 const& other : {closest_on_segment(b, c, x), closest_on_segment(c, a, x)})
        if ((other - x).squaredNorm() < (best - x).squaredNorm()) best = other;
    return {best, false};
}

}  // namespace gimdem

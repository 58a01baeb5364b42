// SPDX-License-Identifier: BSD-3-Clause
#include "walls/SurfaceSide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gimdem
{

namespace
{

/// Whether edge ab, seen from above, is crossed from (x, y) on towards +x: 1 where it rises, -1 where it falls. Two
/// triangles get the same answer for an edge that they share, so that no ray slips through between them.
int crossing(Vec3 const& a, Vec3 const& b, double x, double y)
{
    if ((a.y() > y) == (b.y() > y)) return 0;
    bool const rises = b.y() > a.y();
    Vec3 const& low = rises ? a : b;
    Vec3 const& high = rises ? b : a;
    double const at = low.x() + (y - low.y()) * ((high.x() - low.x()) / (high.y() - low.y()));
    if (!(at > x)) return 0;
    return rises ? 1 : -1;
}

/// Height of a triangle over (x, y), as far as it reaches.
double height(Vec3 const& a, Vec3 const& b, Vec3 const& c, double x, double y)
{
    Vec3 const normal = (b - a).cross(c - a);
    double const low = std::min({a.z(), b.z(), c.z()}), high = std::max({a.z(), b.z(), c.z()});
    double const at = a.z() - (normal.x() * (x - a.x()) + normal.y() * (y - a.y())) / normal.z();
    return std::isfinite(at) ? std::clamp(at, low, high) : low;
}

}  // namespace

SurfaceSide::SurfaceSide(std::span<WallTriangle const> triangles) : triangles_(triangles)
{
    double high = -std::numeric_limits<double>::infinity();
    low_ = -high;
    for (WallTriangle const& t : triangles)
    {
        low_ = std::min({low_, t.a.x, t.b.x, t.c.x});
        high = std::max({high, t.a.x, t.b.x, t.c.x});
    }
    slabs_.resize(std::clamp<std::size_t>(triangles.size() / 8, 1, 1024));
    width_ = std::max((high - low_) / static_cast<double>(slabs_.size()), std::numeric_limits<double>::min());
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
        auto const [first, last] = std::minmax({triangles[t].a.x, triangles[t].b.x, triangles[t].c.x});
        for (std::int64_t s = slab_of(first); s <= slab_of(last); ++s)
            slabs_[static_cast<std::size_t>(s)].push_back(static_cast<std::int32_t>(t));
    }
}

std::int64_t SurfaceSide::slab_of(double x) const
{
    auto const last = static_cast<double>(slabs_.size() - 1);
    return static_cast<std::int64_t>(std::clamp(std::floor((x - low_) / width_), 0.0, last));
}

int SurfaceSide::winding(Vec3 const& y) const
{
    int count = 0;
    for (std::int32_t const k : slabs_[static_cast<std::size_t>(slab_of(y.x()))])
    {
        WallTriangle const& t = triangles_[static_cast<std::size_t>(k)];
        Vec3 const a = t.a.xyz(), b = t.b.xyz(), c = t.c.xyz();
        int const turns = crossing(a, b, y.x(), y.y()) + crossing(b, c, y.x(), y.y()) + crossing(c, a, y.x(), y.y());
        if (turns != 0 && height(a, b, c, y.x(), y.y()) > y.z()) count += turns;
    }
    return count;
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Which walls a particle touches, each once, theory.md (D.53), (D.54).
#pragma once

#include <cmath>

#include "walls/NearbyWalls.hpp"
#include "walls/SurfacePlanes.hpp"

namespace gimdem
{

/// One surface that a particle touches, in space.
struct Touch
{
    std::int32_t pair;  ///< of the list of particle-surface pairs
    std::int32_t surface;
    bool interior;     ///< inside the surface, not on its rim
    bool counts;       ///< no deeper touch stands for it
    Constant3 point;   ///< [m]
    Constant3 normal;  ///< towards the particle
    double overlap;    ///< [m]
    double rank;       ///< overlap, a little more for the interior: the order in which touches stand for others [m]
};

/// The touches of one particle: found, then weeded.
struct WallTouches
{
    NearbyWalls nearby;
    std::int32_t const* plane;  ///< of each pair
    std::uint8_t const* whole;  ///< of each pair

    static constexpr std::int32_t most_at_hand = 16;  ///< pairs of one particle that need no place in memory
    static constexpr double closeness = 1e-6;         ///< of one point to another, in radii [1]

    /// Writes the touches of pairs [begin, end) of a particle at x, w its radius; returns how many.
    GIMDEM_HD std::int32_t find(Quad const& x, std::int32_t begin, std::int32_t end, Touch* touches) const
    {
        std::int32_t count = 0;
        std::int32_t body = -1;
        Vec3 y = Vec3::Zero();
        for (std::int32_t k = begin; k < end; ++k)
        {
            WallSurface const& s = nearby.walls.surfaces[plane[k]];
            if (s.body != body) y = nearby.to_body(body = s.body, x.xyz());
            Touch& touch = touches[count];
            if (!touch_surface(s, k, y, x.w, touch)) continue;
            touch.pair = k;
            touch.surface = plane[k];
            touch.counts = true;
            touch.rank = touch.overlap + (touch.interior ? closeness * x.w + s.slack : 0);
            if (nearby.walls.bodies[body].moves)
            {
                touch.point = constant3(nearby.poses[body].to_space(touch.point.vec()));
                touch.normal = constant3(nearby.poses[body].turn(touch.normal.vec()));
            }
            ++count;
        }
        return count;
    }

    /// Tells which touches count: those that no other stands for. As the deepest of all always counts, and each of the
    /// others falls only to one that is ranked higher, no contact is lost.
    GIMDEM_HD void weed(double radius, Touch* touches, std::int32_t count) const
    {
        for (std::int32_t t = 0; t < count; ++t)
            for (std::int32_t u = 0; u < count && touches[t].counts; ++u)
            {
                bool const is_before =
                    touches[u].rank > touches[t].rank || (touches[u].rank == touches[t].rank && u < t);
                if (is_before && stands_for(touches[u], touches[t], radius)) touches[t].counts = false;
            }
    }

    /// One contact of a smooth patch; an edge or corner that a touched plane holds, or that two planes share.
    GIMDEM_HD bool stands_for(Touch const& u, Touch const& t, double radius) const
    {
        WallSurface const& su = nearby.walls.surfaces[u.surface];
        if (su.patch == nearby.walls.surfaces[t.surface].patch && u.normal.vec().dot(t.normal.vec()) > smooth_cosine)
            return true;
        if (t.interior) return false;
        double const near = closeness * radius + su.slack;
        Vec3 const apart = t.point.vec() - u.point.vec();
        if (!u.interior) return apart.squaredNorm() <= near * near;
        return su.kind != SurfaceKind::cylinder && std::abs(apart.dot(u.normal.vec())) <= near;
    }

private:
    /// Whether a particle at y in the body's frame touches a surface; fills the geometry of `touch` in that frame.
    GIMDEM_HD bool touch_surface(WallSurface const& s, std::int32_t k, Vec3 const& y, double radius, Touch& touch) const
    {
        if (s.kind == SurfaceKind::cylinder) return touch_cylinder(s, y, radius, touch);
        Vec3 const into = s.normal.xyz();
        double const height = into.dot(y) - s.normal.w;
        if (whole[k] != 0) return touch_inside(s, y - height * into, height, radius, touch);
        if (std::abs(height) >= radius + s.slack) return false;
        SurfacePoint const at = nearby.closest(nearby.run_of(plane[k], y), y);
        if (!at.interior) return touch_rim(at, y, radius, touch);
        double const side = (y - at.point).dot(into);
        if (at.distance >= radius && side > 0) return false;
        if (!s.two_sided && side < -s.behind * radius) return false;
        return touch_inside(s, at.point, side, radius, touch);
    }

    GIMDEM_HD static bool touch_inside(WallSurface const& s, Vec3 const& point, double height, double radius,
                                       Touch& touch)
    {
        bool const is_back = s.two_sided && height < 0;
        double const distance = is_back ? -height : height;
        if (distance >= radius) return false;
        touch.interior = true;
        touch.point = constant3(point);
        touch.normal = constant3(is_back ? Vec3(-s.normal.xyz()) : s.normal.xyz());
        touch.overlap = radius - distance;
        return true;
    }

    GIMDEM_HD static bool touch_rim(SurfacePoint const& at, Vec3 const& y, double radius, Touch& touch)
    {
        if (at.distance >= radius || at.distance <= 0) return false;
        touch.interior = false;
        touch.point = constant3(at.point);
        touch.normal = constant3((y - at.point) / at.distance);
        touch.overlap = radius - at.distance;
        return true;
    }

    /// theory.md (D.55)
    GIMDEM_HD static bool touch_cylinder(WallSurface const& s, Vec3 const& y, double radius, Touch& touch)
    {
        SurfacePoint const at = NearbyWalls::closest_on_cylinder(s, y);
        if (!at.interior) return touch_rim(at, y, radius, touch);
        Vec3 const from_axis = at.point - s.point.xyz();
        Vec3 const outward = (from_axis - from_axis.dot(s.normal.xyz()) * s.normal.xyz()) / s.normal.w;
        Vec3 const into = s.inside ? Vec3(-outward) : outward;
        double const height = (y - at.point).dot(into);
        if (height >= radius || height < -s.behind * radius) return false;
        touch.interior = true;
        touch.point = constant3(at.point);
        touch.normal = constant3(into);
        touch.overlap = radius - height;
        return true;
    }
};

}  // namespace gimdem

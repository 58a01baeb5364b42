// SPDX-License-Identifier: BSD-3-Clause
/// Looks at the walls around a point.
#pragma once

#include "walls/Triangle.hpp"
#include "walls/WallMotion.hpp"
#include "walls/WallView.hpp"

namespace gimdem
{

/// Closest point of one surface near a point, in the body frame.
struct SurfacePoint
{
    Vec3 point;
    double distance;
    bool interior;  ///< inside the surface, not on its rim
};

/// Some triangles of one surface: entries of a grid box, or of the list of all triangles where `direct`.
struct SurfaceRun
{
    std::int32_t surface, begin, end;
    bool direct;
};

struct NearbyWalls
{
    WallView walls;
    WallPose const* poses;  ///< of each body

    /// Surfaces of at most this many triangles are looked at whole.
    static constexpr std::int32_t few_triangles = 8;

    GIMDEM_HD Vec3 to_body(std::int32_t body, Vec3 const& x) const
    {
        return walls.bodies[body].moves ? poses[body].to_body(x) : x;
    }

    /// Calls visit(y, run) for every surface that may be within reach of x: y is x in the frame of its body.
    template <class Visit>
    GIMDEM_HD void operator()(Vec3 const& x, Visit&& visit) const
    {
        for (std::int32_t b = 0; b < walls.body_count; ++b)
            visit_body(walls.bodies[b], to_body(b, x), visit);
    }

    /// The same for one body; y is in its frame.
    template <class Visit>
    GIMDEM_HD void visit_body(WallBody const& body, Vec3 const& y, Visit&& visit) const
    {
        if (!body.has_triangles)
            for (std::int32_t s = body.surface; s < body.surface_end; ++s)
                visit(y, SurfaceRun{s, 0, 0, true});
        else if ((y.array() >= body.low.vec().array()).all() && (y.array() <= body.high.vec().array()).all())
            visit_box(body, y, visit);
    }

    /// The triangles of a surface that may be within reach of y.
    GIMDEM_HD SurfaceRun run_of(std::int32_t surface, Vec3 const& y) const
    {
        WallSurface const& s = walls.surfaces[surface];
        if (s.triangle_count <= few_triangles) return {surface, s.triangle, s.triangle + s.triangle_count, true};
        WallBody const& body = walls.bodies[s.body];
        std::int32_t const* const offsets = walls.grid_offsets + body.grid_begin + body.grid.cell_of(y);
        std::int32_t const begin = first_of(surface, offsets[0], offsets[1]);
        return {surface, begin, first_of(surface + 1, begin, offsets[1]), false};
    }

    GIMDEM_HD WallTriangle const& triangle(SurfaceRun const& run, std::int32_t k) const
    {
        return walls.triangles[run.direct ? k : walls.grid_triangles[k]];
    }

    GIMDEM_HD SurfacePoint closest(SurfaceRun const& run, Vec3 const& y) const
    {
        SurfacePoint best{y, 1e300, false};
        for (std::int32_t k = run.begin; k < run.end; ++k)
        {
            WallTriangle const& t = triangle(run, k);
            ClosestPoint const here = closest_on_triangle(t.a.xyz(), t.b.xyz(), t.c.xyz(), y);
            double const distance = (here.point - y).norm();
            if (here.interior) return {here.point, distance, true};
            if (distance < best.distance) best = {here.point, distance, false};
        }
        // A point on a seam between triangles is inside the surface, unless the seam is its rim.
        best.interior = distance_to_rim(run, best.point) > 1e-9 * best.distance;
        return best;
    }

    GIMDEM_HD double distance_to_rim(SurfaceRun const& run, Vec3 const& point) const
    {
        double least = 1e300;
        auto const look = [&](Quad const& a, Quad const& b)
        {
            double const distance = (closest_on_segment(a.xyz(), b.xyz(), point) - point).norm();
            if (distance < least) least = distance;
        };
        for (std::int32_t k = run.begin; k < run.end; ++k)
        {
            WallTriangle const& t = triangle(run, k);
            if ((t.rim & 1) != 0) look(t.a, t.b);
            if ((t.rim & 2) != 0) look(t.b, t.c);
            if ((t.rim & 4) != 0) look(t.c, t.a);
        }
        return least;
    }

    /// Closest point of a tube, theory.md (D.55). On the axis, where all directions are as good, none is given.
    GIMDEM_HD static SurfacePoint closest_on_cylinder(WallSurface const& s, Vec3 const& y)
    {
        Vec3 const axis = s.normal.xyz(), from_start = y - s.point.xyz();
        double const along = from_start.dot(axis);
        Vec3 const across = from_start - along * axis;
        double const distance = across.norm();
        if (!(distance > 0)) return {y, 1e300, false};
        double const kept = s.endless ? along : along < 0 ? 0 : (along > s.point.w ? s.point.w : along);
        Vec3 const point = s.point.xyz() + kept * axis + s.normal.w / distance * across;
        return {point, (point - y).norm(), kept == along};
    }

private:
    template <class Visit>
    GIMDEM_HD void visit_box(WallBody const& body, Vec3 const& y, Visit&& visit) const
    {
        std::int32_t const* const offsets = walls.grid_offsets + body.grid_begin + body.grid.cell_of(y);
        for (std::int32_t k = offsets[0]; k < offsets[1];)
        {
            SurfaceRun run{walls.triangles[walls.grid_triangles[k]].plane, k, k, false};
            while (run.end < offsets[1] && triangle(run, run.end).plane == run.surface)
                ++run.end;
            visit(y, run);
            k = run.end;
        }
    }

    /// First entry in [begin, end) of a box's list that belongs to `surface` or a later one.
    GIMDEM_HD std::int32_t first_of(std::int32_t surface, std::int32_t begin, std::int32_t end) const
    {
        while (begin < end)
        {
            std::int32_t const middle = begin + (end - begin) / 2;
            if (walls.triangles[walls.grid_triangles[middle]].plane < surface)
                begin = middle + 1;
            else
                end = middle;
        }
        return begin;
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "engine/WallStepCheck.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/Error.hpp"
#include "walls/BoxCorners.hpp"

namespace gimdem
{

namespace
{

/// Largest way along its normal of what particles can meet of a wall within dt [m], (D.58).
class LargestStep
{
public:
    LargestStep(WallGeometry const& walls, std::int32_t body, PolyMesh const& mesh, double dt)
        : walls_(walls), body_(body), motion_(walls.motion(body)), mesh_(mesh), dt_(dt)
    {
    }

    double operator()() const
    {
        WallView const view = walls_.view();
        WallBody const& body = view.bodies[body_];
        if (body.has_triangles) return of_triangles();
        WallSurface const& s = view.surfaces[body.surface];
        return s.kind == SurfaceKind::plane ? of_plane(s) : of_tube(s);
    }

private:
    /// Linear over a triangle: largest in a corner.
    double of_triangles() const
    {
        double most = 0;
        for (WallTriangle const& t : walls_.triangles_of(body_))
        {
            Vec3 const a = t.a.xyz(), b = t.b.xyz(), c = t.c.xyz();
            Vec3 const normal = (b - a).cross(c - a).stableNormalized();
            for (Vec3 const& corner : {a, b, c})
                most = std::max(most, motion_.step_along(normal, corner, dt_));
        }
        return most;
    }

    /// The same in all points above each other: largest in a corner of the mesh.
    double of_plane(WallSurface const& s) const
    {
        double most = 0;
        visit_corners(mesh_.low(), mesh_.high(),
                      [&](Vec3 const& y) { most = std::max(most, motion_.step_along(s.normal.xyz(), y, dt_)); });
        return most;
    }

    /// That of its axis across itself, as far as the mesh goes.
    double of_tube(WallSurface const& s) const
    {
        Vec3 const axis = s.normal.xyz(), start = s.point.xyz();
        double most = 0;
        visit_corners(mesh_.low(), mesh_.high(),
                      [&](Vec3 const& x)
                      {
                          Vec3 const y = start + axis.dot(x - start) * axis;
                          most = std::max(most, motion_.step_across(axis, y, dt_));
                      });
        return most;
    }

    WallGeometry const& walls_;
    std::int32_t body_;
    WallMotion const& motion_;
    PolyMesh const& mesh_;
    double dt_;
};

}  // namespace

void check_wall_steps(Case const& settings, WallGeometry const& walls, PolyMesh const& mesh, double smallest_radius)
{
    double const dt = settings.dem.time_step;
    for (std::int32_t b = 0; b < walls.body_count(); ++b)
    {
        if (!walls.motion(b).moves()) continue;
        double const step = LargestStep(walls, b, mesh, dt)();
        double const limit = wall_step_limit * smallest_radius;
        if (step <= limit || smallest_radius == 0) continue;
        throw UserError(fmt::format(
            "{} moves {:.3g} m in a time step of {:.3g} s (that is {:.3g} of the smallest radius, {:.3g} m: above {} a "
            "wall may pass a particle unseen); use [dem] time_step = {:.2g} or less, or a slower wall",
            walls.name(b), step, dt, step / smallest_radius, smallest_radius, wall_step_limit,
            0.95 * dt * limit / step));
    }
}

}  // namespace gimdem

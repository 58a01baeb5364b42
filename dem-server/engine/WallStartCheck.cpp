// SPDX-License-Identifier: BSD-3-Clause
#include "engine/WallStartCheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/Error.hpp"
#include "walls/NearbyWalls.hpp"
#include "walls/SurfaceSide.hpp"

namespace gimdem
{

namespace
{

/// One wall, and where particles are in its frame.
class WallOfStart
{
public:
    WallOfStart(WallGeometry const& walls, std::int32_t body)
        : view_(walls.view()), body_(view_.bodies[body]), name_(walls.name(body))
    {
        pose_ = walls.motion(body).at(0);
        if (walls.is_closed(body)) side_.emplace(walls.triangles_of(body));
    }

    void check(Quad const& x, std::int64_t id) const
    {
        Vec3 const y = pose_.to_body(x.xyz());
        if (is_behind(y))
            throw UserError(
                fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m starts behind {} (which holds particles on its "
                            "other side); move the box of its [[insertion]], or turn the wall over by normal or inside",
                            id, x.x, x.y, x.z, name_));
        double const overlap = x.w - distance(y);
        if (overlap <= start_overlap_limit * 2 * x.w) return;
        throw UserError(
            fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m starts {:.3g} m deep in {} (it would be thrown "
                        "off); move the box of its [[insertion]] by as much, or the wall",
                        id, x.x, x.y, x.z, overlap, name_));
    }

private:
    bool is_behind(Vec3 const& y) const
    {
        WallSurface const& s = view_.surfaces[body_.surface];
        if (side_) return side_->winding(y) != (s.inside ? -1 : 0);
        if (s.kind == SurfaceKind::plane) return s.normal.xyz().dot(y) < s.normal.w;
        if (s.kind != SurfaceKind::cylinder || !s.endless) return false;
        Vec3 const from = y - s.point.xyz();
        double const across = (from - from.dot(s.normal.xyz()) * s.normal.xyz()).norm();
        return s.inside ? across > s.normal.w : across < s.normal.w;
    }

    double distance(Vec3 const& y) const
    {
        WallSurface const& s = view_.surfaces[body_.surface];
        if (s.kind == SurfaceKind::plane) return s.normal.xyz().dot(y) - s.normal.w;
        if (s.kind == SurfaceKind::cylinder) return NearbyWalls::closest_on_cylinder(s, y).distance;
        NearbyWalls const nearby{view_, nullptr};
        double least = 1e300;
        nearby.visit_body(body_, y,
                          [&](Vec3 const&, SurfaceRun const& run)
                          { least = std::min(least, nearby.closest(run, y).distance); });
        return least;
    }

    WallView view_;
    WallBody const& body_;
    std::string name_;
    WallPose pose_;
    std::optional<SurfaceSide> side_;
};

}  // namespace

void check_particles_against_walls(ParticleState const& particles, WallGeometry const& walls)
{
    for (std::int32_t b = 0; b < walls.body_count(); ++b)
    {
        if (walls.view().bodies[b].surface == walls.view().bodies[b].surface_end) continue;
        WallOfStart const wall(walls, b);
        for (std::int64_t i = 0; i < particles.count(); ++i)
            wall.check(particles.position[i], particles.id[i]);
    }
}

}  // namespace gimdem

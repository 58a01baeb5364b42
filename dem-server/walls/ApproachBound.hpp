// SPDX-License-Identifier: BSD-3-Clause
/// For how long a list of particle-wall pairs holds where walls move.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "walls/BoxCorners.hpp"
#include "walls/WallMotion.hpp"
#include "walls/WallView.hpp"

namespace gimdem
{

/// How far a surface may have come nearer to any point of a box, between two poses [m], theory.md (D.56).
class ApproachBound
{
public:
    ApproachBound(WallPose const& then, WallPose const& now) : then_(then), now_(now) {}

    /// Any surface within [low, high] of the body frame.
    double of_box(Vec3 const& low, Vec3 const& high) const
    {
        double most = 0;
        visit_corners(low, high,
                      [&](Vec3 const& y) { most = std::max(most, (now_.to_space(y) - then_.to_space(y)).norm()); });
        return most;
    }

    /// An infinite plane or a tube, near points of [low, high] in space.
    double of(WallSurface const& s, Vec3 const& low, Vec3 const& high) const
    {
        return s.kind == SurfaceKind::plane ? of_plane(s, low, high) : of_tube(s, low, high);
    }

private:
    /// The signed distance is affine in space: its change is largest in a corner.
    double of_plane(WallSurface const& s, Vec3 const& low, Vec3 const& high) const
    {
        double most = 0;
        visit_corners(low, high,
                      [&](Vec3 const& x) {
                          most = std::max(most, std::abs(s.normal.xyz().dot(now_.to_body(x)) -
                                                         s.normal.xyz().dot(then_.to_body(x))));
                      });
        return most;
    }

    /// The axis, as far as the box sees it: motion along itself changes nothing, unless the tube has ends.
    double of_tube(WallSurface const& s, Vec3 const& low, Vec3 const& high) const
    {
        Vec3 const axis = s.normal.xyz(), start = s.point.xyz();
        double first = std::numeric_limits<double>::infinity(), last = -first;
        visit_corners(low, high,
                      [&](Vec3 const& x)
                      {
                          for (WallPose const* pose : {&then_, &now_})
                          {
                              double const along = axis.dot(pose->to_body(x) - start);
                              first = std::min(first, along);
                              last = std::max(last, along);
                          }
                      });
        double most = 0;
        for (double const along : {first, last})
        {
            Vec3 const moved = now_.to_space(start + along * axis) - then_.to_space(start + along * axis);
            for (WallPose const* pose : {&then_, &now_})
            {
                Vec3 const a = pose->turn(axis);
                most = std::max(most, s.endless ? (moved - moved.dot(a) * a).norm() : moved.norm());
            }
        }
        return most;
    }

    WallPose const& then_;
    WallPose const& now_;
};

}  // namespace gimdem

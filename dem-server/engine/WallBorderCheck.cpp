// SPDX-License-Identifier: BSD-3-Clause
#include "engine/WallBorderCheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/Error.hpp"

namespace gimdem
{

namespace
{

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double flat = 1e-9;  // what counts as no part of a unit vector

using Span = std::array<double, 2>;

Span widened(Span const& a, double by)
{
    return {a[0] - by, a[1] + by};
}

Span united(Span const& a, Span const& b)
{
    return {std::min(a[0], b[0]), std::max(a[1], b[1])};
}

/// What a wall ever covers of one axis.
class WallSpan
{
public:
    WallSpan(WallGeometry const& walls, std::int32_t body, int axis)
        : walls_(walls), body_(body), motion_(walls.motion(body)), axis_(axis)
    {
    }

    /// [m]; an empty one, {infinity, -infinity}, where the wall is the same all along the axis.
    Span operator()() const
    {
        WallView const view = walls_.view();
        if (view.bodies[body_].has_triangles) return of_triangles();
        WallSurface const& s = view.surfaces[view.bodies[body_].surface];
        Span const direction = motion_.span_of_direction(axis_, s.normal.xyz());
        bool const is_across = std::max(std::abs(direction[0]), std::abs(direction[1])) < flat;
        if (s.kind == SurfaceKind::plane) return is_across ? nothing : everything;
        bool const is_along = std::min(std::abs(direction[0]), std::abs(direction[1])) > 1 - flat;
        if (s.endless && is_along) return nothing;
        if (s.endless && !is_across) return everything;
        return of_tube(s, is_along);
    }

private:
    static constexpr Span nothing{endless, -endless}, everything{-endless, endless};

    Span of_triangles() const
    {
        Span all = nothing;
        for (WallTriangle const& t : walls_.triangles_of(body_))
            for (Quad const& corner : {t.a, t.b, t.c})
                all = united(all, motion_.span_of_point(axis_, corner.xyz()));
        return all;
    }

    Span of_tube(WallSurface const& s, bool is_along) const
    {
        Span const start = motion_.span_of_point(axis_, s.point.xyz());
        Span const end = motion_.span_of_point(axis_, s.point.xyz() + (s.endless ? 0 : s.point.w) * s.normal.xyz());
        return widened(united(start, end), is_along ? 0 : s.normal.w);
    }

    WallGeometry const& walls_;
    std::int32_t body_;
    WallMotion const& motion_;
    int axis_;
};

void check_body(DomainSettings const& domain, WallGeometry const& walls, std::int32_t body, int axis, double reach)
{
    Span const covered = WallSpan(walls, body, axis)();
    for (std::size_t side = 0; side < 2; ++side)
    {
        double const border = domain.box[side][static_cast<std::size_t>(axis)];
        double const room = side == 0 ? covered[0] - border : border - covered[1];
        if (room >= reach) continue;
        throw UserError(fmt::format(
            "{} {} {}{}, where [domain] is periodic (particles on the other side of the border would not feel "
            "it); keep it {:.3g} m or more within the box all the time, use a plane or a tube without length "
            "that goes on along {}, or leave that axis out of periodic",
            walls.name(body), room > 0 ? fmt::format("comes to {:.3g} m from", room) : std::string("reaches beyond"),
            "xyz"[axis], side == 0 ? "min" : "max", reach, "xyz"[axis]));
    }
}

}  // namespace

void check_walls_in_periodic_box(DomainSettings const& domain, WallGeometry const& walls, double reach)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        if (!domain.periodic[static_cast<std::size_t>(axis)]) continue;
        for (std::int32_t b = walls.first_item(); b < walls.body_count(); ++b)
            check_body(domain, walls, b, axis, reach);
    }
}

}  // namespace gimdem

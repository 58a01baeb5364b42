// SPDX-License-Identifier: BSD-3-Clause
/// What a flat convex facet does to a ball, in closed form: the building block of the exact overlap of a ball and a
/// polyhedron, theory.md (G.20)-(G.25). All points are relative to the centre of the ball.
#pragma once

#include <cmath>

#include "exec/Vector.hpp"

namespace gimdem::overlap
{

/// An angle that is added up without taking it: a complex number with this argument. Sums stay below pi.
struct Turn
{
    double x = 1, y = 0;

    GIMDEM_HD void add(double dx, double dy)
    {
        double const old = x;
        x = old * dx - y * dy;
        y = old * dy + y * dx;
    }
    GIMDEM_HD double angle() const { return y == 0 && x >= 0 ? 0 : std::atan2(y, x); }
};

/// A facet's edge in the facet's plane, seen from the foot of the perpendicular from the centre.
struct EdgeInPlane
{
    double distance;    ///< p of its line from the foot, positive where the foot is on the facet's side [m]
    double start, end;  ///< t of its corners along it, from the point of its line nearest to the foot [m]

    /// For an edge from a along a unit vector, w: its length, that runs counterclockwise around the unit normal.
    GIMDEM_HD EdgeInPlane(Vec3 const& a, Quad const& edge, Vec3 const& normal)
    {
        Vec3 const along = edge.xyz();
        distance = along.cross(normal).dot(a);
        start = along.dot(a);
        end = start + edge.w;
    }
    EdgeInPlane() = default;

    /// The angle at the foot between the places t0 and t1.
    GIMDEM_HD void add_angle(double t0, double t1, Turn& turn) const
    {
        turn.add(distance * distance + t0 * t1, distance * (t1 - t0));
    }
};

/// A corner or a crossing of an edge with the sphere.
struct EdgePlace
{
    double along;   ///< t [m]
    double radius;  ///< distance from the centre [m]
};

/// A ball that a plane passes at the distance `height` >= 0 of its centre.
struct BallAtPlane
{
    double radius;  ///< R [m]
    double height;  ///< h [m]

    GIMDEM_HD double third_of_cube() const { return radius * radius * radius / 3; }
    GIMDEM_HD double disc2() const { return radius * radius - height * height; }
    /// Volume beyond the plane for each radian of the disc, (G.23).
    GIMDEM_HD double cap_per_angle() const { return (radius - height) * (radius - height) * (2 * radius + height) / 6; }

    GIMDEM_HD EdgePlace corner(EdgeInPlane const& edge, double t) const
    {
        return {t, std::sqrt(height * height + edge.distance * edge.distance + t * t)};
    }

    /// psi of (G.21): tan psi = h t / (p |v|).
    GIMDEM_HD void add_dihedral(EdgeInPlane const& edge, EdgePlace const& from, EdgePlace const& to, Turn& turn) const
    {
        turn.add(edge.distance * to.radius, height * to.along);
        turn.add(edge.distance * from.radius, -height * from.along);
    }

    /// Solid angle of the triangle of the foot and a part of an edge, (G.22).
    GIMDEM_HD double solid_angle(EdgeInPlane const& edge, EdgePlace const& from, EdgePlace const& to) const
    {
        Turn turn;
        add_solid(edge, to, 1, turn);
        add_solid(edge, from, -1, turn);
        return turn.angle();
    }

private:
    // tan(phi - psi) = t p (|v| - h) / (p^2 |v| + h t^2), without the difference.
    GIMDEM_HD void add_solid(EdgeInPlane const& edge, EdgePlace const& at, double sign, Turn& turn) const
    {
        double const p2 = edge.distance * edge.distance, t2 = at.along * at.along;
        turn.add(p2 * at.radius + height * t2, sign * at.along * edge.distance * (p2 + t2) / (at.radius + height));
    }
};

/// What of an edge is inside of the disc that the plane cuts out of the ball, and what is outside.
struct EdgeOnDisc
{
    BallAtPlane const& ball;
    EdgeInPlane const& edge;
    EdgePlace from, to;   ///< of the part inside
    bool inside = false;  ///< whether there is one
    bool before = false;  ///< whether there is a part outside before it, or all is outside
    bool after = false;   ///< whether there is one after it

    GIMDEM_HD EdgeOnDisc(BallAtPlane const& ball_, EdgeInPlane const& edge_) : ball(ball_), edge(edge_)
    {
        double const crossing2 = ball.disc2() - edge.distance * edge.distance;
        double const crossing = crossing2 > 0 ? std::sqrt(crossing2) : 0;
        before = edge.start < -crossing;
        after = edge.end > crossing;
        from = before ? EdgePlace{-crossing, ball.radius} : ball.corner(edge, edge.start);
        to = after ? EdgePlace{crossing, ball.radius} : ball.corner(edge, edge.end);
        inside = crossing2 > 0 && from.along < to.along;
        if (inside) return;
        before = true;
        after = false;
    }

    /// Calls visit(from, to) for each part outside.
    template <class Visit>
    GIMDEM_HD void visit_outside(Visit visit) const
    {
        if (!inside) return visit(ball.corner(edge, edge.start), ball.corner(edge, edge.end));
        if (before) visit(ball.corner(edge, edge.start), from);
        if (after) visit(to, ball.corner(edge, edge.end));
    }

    /// Angle at the foot of what is outside.
    GIMDEM_HD double angle_outside() const
    {
        Turn turn;
        visit_outside([&](EdgePlace const& a, EdgePlace const& b) { edge.add_angle(a.along, b.along, turn); });
        return turn.angle();
    }
};

/// Volume of the ball beyond the facet, within the cone from the centre through the facet; positive, (G.23). For
/// height < radius.
GIMDEM_HD inline double volume_beyond(BallAtPlane const& ball, EdgeInPlane const* edges, int count)
{
    double const disc = std::sqrt(ball.disc2());
    bool cut = false;
    for (int k = 0; k < count; ++k)
    {
        if (edges[k].distance <= -disc) return 0;
        cut = cut || edges[k].distance < disc;
    }
    if (!cut) return 2 * 3.14159265358979323846 * ball.cap_per_angle();

    double angle = 0, solid = 0, cone = 0;
    for (int k = 0; k < count; ++k)
    {
        EdgeOnDisc const on(ball, edges[k]);
        angle += on.angle_outside();
        if (!on.inside) continue;
        solid += ball.solid_angle(edges[k], on.from, on.to);
        cone += edges[k].distance * (on.to.along - on.from.along);
    }
    return ball.cap_per_angle() * angle + ball.third_of_cube() * solid - ball.height / 6 * cone;
}

/// Volume that the ball shares with the cone from its centre to the facet, (G.24): continuous wherever the centre is,
/// on the facet, its edges and corners too.
GIMDEM_HD inline double volume_of_cone(BallAtPlane const& ball, EdgeInPlane const* edges, int count)
{
    double sum = 0;
    for (int k = 0; k < count; ++k)
    {
        EdgeInPlane const& edge = edges[k];
        if (ball.height >= ball.radius)
        {
            sum += ball.third_of_cube() *
                   ball.solid_angle(edge, ball.corner(edge, edge.start), ball.corner(edge, edge.end));
            continue;
        }
        EdgeOnDisc const on(ball, edge);
        if (on.inside) sum += ball.height / 6 * edge.distance * (on.to.along - on.from.along);
        Turn dihedral;
        on.visit_outside([&](EdgePlace const& a, EdgePlace const& b) { ball.add_dihedral(edge, a, b, dihedral); });
        double const per_angle = ball.height * (3 * ball.radius * ball.radius - ball.height * ball.height) / 6;
        sum += per_angle * on.angle_outside() - ball.third_of_cube() * dihedral.angle();
    }
    return sum;
}

}  // namespace gimdem::overlap

// SPDX-License-Identifier: BSD-3-Clause
/// Volume that a ball and a cell of any shape share, in closed form, theory.md (G.20)-(G.25).
#pragma once

#include <cmath>
#include <cstdint>

#include "mapping/overlap/CellFacets.hpp"
#include "mapping/overlap/FacetOverlap.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem::overlap
{

/// A facet in the frame of a ball.
struct FacetAtBall
{
    double height;  ///< of the plane over the centre along the normal [m]
    int count;
    EdgeInPlane edges[CellFacetsView::most_corners];

    GIMDEM_HD FacetAtBall(CellFacetsView const& facets, std::int32_t facet, Vec3 const& centre)
    {
        std::int32_t const first = facets.corner_offsets[facet];
        count = facets.corner_offsets[facet + 1] - first;
        Vec3 const normal = facets.normal[facet].xyz();
        Vec3 a = facets.point(facets.corners[first + count - 1]) - centre;
        height = normal.dot(a);
        for (int k = 0; k < count; ++k)
        {
            edges[k] = EdgeInPlane(a, facets.edges[first + k], normal);
            a = facets.point(facets.corners[first + k]) - centre;
        }
    }
};

/// Overlaps of one ball with cells.
struct BallOverlap
{
    /// A centre that is deeper than this behind all facets of a cell, in units of the radius, is inside of it and
    /// outside of all others without a doubt.
    static constexpr double margin = 0.01;

    CellFacetsView facets;
    Vec3 centre;
    double radius;

    /// False where they share nothing, for sure.
    GIMDEM_HD bool may_touch(std::int32_t cell) const { return facets.boxes[cell].distance2(centre) < radius * radius; }

    /// How deep the centre is behind the facet's plane that it is least behind of [m]; negative: beyond one.
    GIMDEM_HD double depth(std::int32_t cell) const
    {
        double least = 1e300;
        visit_facets(cell,
                     [&](std::int32_t facet, double side)
                     {
                         double const h = side * height(facet);
                         least = h < least ? h : least;
                     });
        return least;
    }

    /// Volume shared with a cell [m^3], wherever the centre is.
    GIMDEM_HD double operator()(std::int32_t cell) const
    {
        if (!may_touch(cell)) return 0;
        double const d = depth(cell);
        if (d >= radius) return sphere_volume(radius);
        double const volume = d > margin * radius ? sphere_volume(radius) - beyond(cell) : sum_of_cones(cell);
        return volume > 0 ? volume : 0;
    }

    /// Volume that leaves the cell through its facets less what enters, (G.23): for a centre that is deep inside of a
    /// cell, this one or another.
    GIMDEM_HD double beyond(std::int32_t cell) const
    {
        double sum = 0;
        visit_facets(cell, [&](std::int32_t facet, double side) { sum += side * through_facet(facet); });
        return sum;
    }

    /// What leaves a face's owner through it, less what enters, (G.23).
    GIMDEM_HD double through(std::int32_t face) const
    {
        double sum = 0;
        for (std::int32_t i = facets.facet_offsets[face]; i < facets.facet_offsets[face + 1]; ++i)
            sum += through_facet(i);
        return sum;
    }

    /// The same volume as operator(), from all facets, (G.24).
    GIMDEM_HD double sum_of_cones(std::int32_t cell) const
    {
        double sum = 0;
        visit_facets(cell,
                     [&](std::int32_t facet, double side)
                     {
                         FacetAtBall const at(facets, facet, centre);
                         double const volume = volume_of_cone({radius, std::abs(at.height)}, at.edges, at.count);
                         sum += (at.height < 0 ? -side : side) * volume;
                     });
        return sum;
    }

private:
    GIMDEM_HD double height(std::int32_t facet) const
    {
        std::int32_t const last = facets.corner_offsets[facet + 1] - 1;
        return facets.normal[facet].xyz().dot(facets.point(facets.corners[last]) - centre);
    }

    GIMDEM_HD double through_facet(std::int32_t facet) const
    {
        double const h = height(facet);
        if (!(std::abs(h) < radius)) return 0;
        FacetAtBall const at(facets, facet, centre);
        double const volume = volume_beyond({radius, std::abs(h)}, at.edges, at.count);
        return h < 0 ? -volume : volume;
    }

    /// visit(facet, side) with side 1 where the facet's normal leaves the cell, else -1.
    template <class Visit>
    GIMDEM_HD void visit_facets(std::int32_t cell, Visit visit) const
    {
        for (std::int32_t k = facets.cell_offsets[cell]; k < facets.cell_offsets[cell + 1]; ++k)
        {
            std::int32_t const face = facets.cell_faces[k];
            double const side = facets.owner[face] == cell ? 1 : -1;
            for (std::int32_t i = facets.facet_offsets[face]; i < facets.facet_offsets[face + 1]; ++i)
                visit(i, side);
        }
    }
};

/// The same for a row of all cells that a ball may touch, whose centre is deep inside of the first: what one cell loses
/// through a face its neighbour gains, (G.23), so each face is taken once, for its owner.
GIMDEM_HD inline void exchange_through_faces(BallOverlap const& ball, std::int32_t const* cells, int count,
                                             double* volumes)
{
    CellFacetsView const& facets = ball.facets;
    volumes[0] = sphere_volume(ball.radius);
    for (int k = 0; k < count; ++k)
    {
        std::int32_t const cell = cells[k];
        if (!ball.may_touch(cell)) continue;
        for (std::int32_t i = facets.cell_offsets[cell]; i < facets.cell_offsets[cell + 1]; ++i)
        {
            std::int32_t const face = facets.cell_faces[i];
            double const leaving = facets.owner[face] == cell ? ball.through(face) : 0;
            if (leaving == 0) continue;
            volumes[k] -= leaving;
            if (face >= facets.internal_face_count) continue;
            int other = 0;
            while (other < count && cells[other] != facets.neighbour[face])
                ++other;
            if (other < count) volumes[other] += leaving;
        }
    }
    for (int k = 0; k < count; ++k)
        volumes[k] = volumes[k] > 0 ? volumes[k] : 0;
}

/// Overlaps with a row of all cells that a ball may touch, of which the first is the one that holds the centre.
GIMDEM_HD inline void overlap_with_row(BallOverlap const& ball, std::int32_t const* cells, int count, double* volumes)
{
    for (int k = 0; k < count; ++k)
        volumes[k] = 0;
    double const depth = ball.depth(cells[0]);
    if (depth >= ball.radius)
        volumes[0] = sphere_volume(ball.radius);
    else if (depth > BallOverlap::margin * ball.radius)
        exchange_through_faces(ball, cells, count, volumes);
    else
        for (int k = 0; k < count; ++k)
            volumes[k] = ball(cells[k]);
}

}  // namespace gimdem::overlap

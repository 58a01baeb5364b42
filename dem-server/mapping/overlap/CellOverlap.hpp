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
            Vec3 const b = facets.point(facets.corners[first + k]) - centre;
            edges[k] = EdgeInPlane(a, b, normal);
            a = b;
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
        visit_facets(cell,
                     [&](std::int32_t facet, double side)
                     {
                         double const h = height(facet);
                         if (!(std::abs(h) < radius)) return;
                         FacetAtBall const at(facets, facet, centre);
                         double const volume = volume_beyond({radius, std::abs(h)}, at.edges, at.count);
                         sum += (h < 0 ? -side : side) * volume;
                     });
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

/// Overlaps with a row of cells, of which the first is the one that holds the centre.
GIMDEM_HD inline void overlap_with_row(BallOverlap const& ball, std::int32_t const* cells, int count, double* volumes)
{
    double const depth = ball.depth(cells[0]);
    bool const deep = depth > BallOverlap::margin * ball.radius;
    volumes[0] = depth >= ball.radius ? sphere_volume(ball.radius) : ball(cells[0]);
    for (int k = 1; k < count; ++k)
    {
        volumes[k] = 0;
        if (depth >= ball.radius) continue;
        if (!deep)
            volumes[k] = ball(cells[k]);
        else if (ball.may_touch(cells[k]))
        {
            double const volume = -ball.beyond(cells[k]);
            volumes[k] = volume > 0 ? volume : 0;
        }
    }
}

}  // namespace gimdem::overlap

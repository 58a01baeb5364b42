// SPDX-License-Identifier: BSD-3-Clause
#include "walls/SurfacePlanes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gimdem
{

PatchJoiner::PatchJoiner(std::int32_t planes) : parent_(static_cast<std::size_t>(planes))
{
    std::iota(parent_.begin(), parent_.end(), 0);
}

void PatchJoiner::join(std::int32_t a, std::int32_t b, Vec3 const& normal_a, Vec3 const& normal_b, bool two_sided)
{
    double const cosine = normal_a.dot(normal_b);
    if (a == b || (two_sided ? std::abs(cosine) : cosine) <= smooth_cosine) return;
    std::int32_t const low = std::min(patch_of(a), patch_of(b)), high = std::max(patch_of(a), patch_of(b));
    parent_[static_cast<std::size_t>(high)] = low;
    parent_[static_cast<std::size_t>(a)] = parent_[static_cast<std::size_t>(b)] = low;  // short ways up
}

std::int32_t PatchJoiner::patch_of(std::int32_t plane) const
{
    while (parent_[static_cast<std::size_t>(plane)] != plane)
        plane = parent_[static_cast<std::size_t>(plane)];
    return plane;
}

namespace
{

/// Floods planes over the surface, the largest triangles first: their normals are the best.
class PlaneFlood
{
public:
    PlaneFlood(SurfaceMesh const& surface, bool two_sided)
        : surface_(surface), two_sided_(two_sided), uses_(edges_of(surface)), neighbors_(surface.triangles.size())
    {
        planes_.plane_of_triangle.assign(surface.triangles.size(), -1);
        planes_.rim_of_triangle.assign(surface.triangles.size(), 0);
        Vec3 low = surface.points.front(), high = low;
        double farthest = 0;
        for (Vec3 const& x : surface.points)
        {
            low = low.cwiseMin(x);
            high = high.cwiseMax(x);
            farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
        }
        // Files hold float: corners of one plane lie off it by the last digit of the largest coordinate.
        tolerance_ = 1e-7 * ((high - low).norm() + farthest);
        for_each_edge(uses_,
                      [this](std::size_t begin, std::size_t end)
                      {
                          for (std::size_t a = begin; a < end; ++a)
                              for (std::size_t b = begin; b < end; ++b)
                                  if (a != b) neighbors_[index(uses_[a].triangle)].push_back(uses_[b].triangle);
                      });
    }

    SurfacePlanes run()
    {
        std::vector<std::int32_t> order(surface_.triangles.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
                         [this](std::int32_t a, std::int32_t b)
                         { return surface_.area_vector(index(a)).norm() > surface_.area_vector(index(b)).norm(); });
        for (std::int32_t const seed : order)
            if (planes_.plane_of_triangle[index(seed)] < 0) flood(seed);
        mark_rims_and_patches();
        return std::move(planes_);
    }

private:
    static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

    /// Grows the plane of a seed over its neighbours, fits it to what it holds, and so on: the normal of one small
    /// triangle is too coarse for a large plane.
    void flood(std::int32_t seed)
    {
        auto const plane = static_cast<std::int32_t>(planes_.planes.size());
        Vec3 const normal = surface_.area_vector(index(seed)).normalized();
        Quad here = Quad::of(normal, normal.dot(surface_.point(index(seed), 0)));
        std::vector<std::int32_t> members{seed};
        planes_.plane_of_triangle[index(seed)] = plane;
        for (std::size_t before = 0; members.size() > before;)
        {
            before = members.size();
            grow(plane, here, members);
            Quad const fitted = fit(members, here);
            if (slack_of(members, fitted) <= tolerance_) here = fitted;
        }
        planes_.planes.push_back(here);
        planes_.slack.push_back(slack_of(members, here));
    }

    void grow(std::int32_t plane, Quad const& here, std::vector<std::int32_t>& members)
    {
        for (std::size_t k = 0; k < members.size(); ++k)
            for (std::int32_t const other : neighbors_[index(members[k])])
                if (planes_.plane_of_triangle[index(other)] < 0 && lies_in(other, here))
                {
                    planes_.plane_of_triangle[index(other)] = plane;
                    members.push_back(other);
                }
    }

    /// Plane along the sum of the triangles' areas, through the mean of their corners.
    Quad fit(std::vector<std::int32_t> const& members, Quad const& before) const
    {
        Vec3 area = Vec3::Zero(), corners = Vec3::Zero();
        Vec3 const from = surface_.point(index(members.front()), 0);
        for (std::int32_t const t : members)
        {
            Vec3 const own = surface_.area_vector(index(t));
            area += own.dot(before.xyz()) < 0 ? Vec3(-own) : own;
            for (int corner = 0; corner < 3; ++corner)
                corners += surface_.point(index(t), corner) - from;
        }
        Vec3 const normal = area.normalized();
        return Quad::of(normal, normal.dot(from + corners / (3.0 * static_cast<double>(members.size()))));
    }

    double slack_of(std::vector<std::int32_t> const& members, Quad const& plane) const
    {
        double most = 0;
        for (std::int32_t const t : members)
            most = std::max(most, distance(t, plane));
        return most;
    }

    /// Largest distance of a corner from the plane [m].
    double distance(std::int32_t t, Quad const& plane) const
    {
        double most = 0;
        for (int corner = 0; corner < 3; ++corner)
            most = std::max(most, std::abs(plane.xyz().dot(surface_.point(index(t), corner)) - plane.w));
        return most;
    }

    bool lies_in(std::int32_t t, Quad const& plane) const
    {
        double const cosine = plane.xyz().dot(surface_.area_vector(index(t)).normalized());
        return (two_sided_ ? std::abs(cosine) : cosine) > 1 - 1e-6 && distance(t, plane) <= tolerance_;
    }

    void mark_rims_and_patches()
    {
        PatchJoiner patches(static_cast<std::int32_t>(planes_.planes.size()));
        for_each_edge(uses_,
                      [&](std::size_t begin, std::size_t end)
                      {
                          std::int32_t const plane = plane_of(begin);
                          bool is_inside = end - begin > 1;
                          for (std::size_t k = begin; k < end; ++k)
                          {
                              is_inside = is_inside && plane_of(k) == plane;
                              patches.join(plane, plane_of(k), planes_.planes[index(plane)].xyz(),
                                           planes_.planes[index(plane_of(k))].xyz(), two_sided_);
                          }
                          for (std::size_t k = begin; k < end && !is_inside; ++k)
                              planes_.rim_of_triangle[index(uses_[k].triangle)] |=
                                  static_cast<std::uint8_t>(1 << uses_[k].side);
                      });
        for (std::size_t p = 0; p < planes_.planes.size(); ++p)
            planes_.patch_of_plane.push_back(patches.patch_of(static_cast<std::int32_t>(p)));
    }

    std::int32_t plane_of(std::size_t use) const { return planes_.plane_of_triangle[index(uses_[use].triangle)]; }

    SurfaceMesh const& surface_;
    bool two_sided_;
    std::vector<EdgeUse> uses_;
    std::vector<std::vector<std::int32_t>> neighbors_;
    double tolerance_ = 0;
    SurfacePlanes planes_;
};

}  // namespace

SurfacePlanes find_planes(SurfaceMesh const& surface, bool two_sided)
{
    return PlaneFlood(surface, two_sided).run();
}

}  // namespace gimdem

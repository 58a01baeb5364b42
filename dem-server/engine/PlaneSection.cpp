// SPDX-License-Identifier: BSD-3-Clause
#include "engine/PlaneSection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/Error.hpp"

namespace gimdem
{

namespace
{

/// Corners of the section of a convex cell: where the edges of its faces cross the plane, ordered by angle around their
/// middle. Each edge is met by two faces, so each corner is found twice.
std::vector<Vec3> section_corners(PolyMesh const& mesh, std::int32_t cell, Vec3 const& point, Vec3 const& normal)
{
    std::vector<Vec3> corners;
    for (std::int32_t const f : mesh.faces_of_cell(cell))
    {
        auto const points = mesh.points_of_face(f);
        for (std::size_t k = 0; k < points.size(); ++k)
        {
            Vec3 const a = mesh.point(points[k]);
            Vec3 const b = mesh.point(points[(k + 1) % points.size()]);
            double const ha = (a - point).dot(normal);
            double const hb = (b - point).dot(normal);
            // Points on the plane count as above it, so that a face in the plane belongs to one cell only.
            if ((ha >= 0) == (hb >= 0)) continue;
            corners.push_back(a + ha / (ha - hb) * (b - a));
        }
    }
    if (corners.size() < 3) return {};
    Vec3 middle = Vec3::Zero();
    for (Vec3 const& corner : corners)
        middle += corner;
    middle /= static_cast<double>(corners.size());
    Vec3 const axis = normal.unitOrthogonal();
    Vec3 const other = normal.cross(axis);
    auto const angle = [&](Vec3 const& x) { return std::atan2((x - middle).dot(other), (x - middle).dot(axis)); };
    std::sort(corners.begin(), corners.end(), [&](Vec3 const& a, Vec3 const& b) { return angle(a) < angle(b); });
    return corners;
}

/// Area and middle of a polygon in a plane.
std::pair<double, Vec3> area_and_middle(std::vector<Vec3> const& corners, Vec3 const& normal)
{
    double area = 0;
    Vec3 moment = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    {
        double const triangle = (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]).dot(normal) / 2;
        area += triangle;
        moment += triangle * (corners[0] + corners[k] + corners[k + 1]) / 3;
    }
    return {area, area > 0 ? Vec3(moment / area) : Vec3::Zero()};
}

}  // namespace

PlaneSection::PlaneSection(PolyMesh const& mesh, PlaneSettings const& plane)
{
    Vec3 const point(plane.point[0], plane.point[1], plane.point[2]);
    Vec3 const normal = Vec3(plane.normal[0], plane.normal[1], plane.normal[2]).normalized();
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        auto const [area, middle] = area_and_middle(section_corners(mesh, c, point, normal), normal);
        if (!(area > 0)) continue;
        parts_.push_back({c, area, middle - mesh.centroid(c)});
        area_ += area;
    }
    if (parts_.empty())
        throw UserError(fmt::format(
            "[output] plane \"{}\" misses the mesh (it has no mean there); move its point inside", plane.name));
}

double PlaneSection::mean(std::span<double const> values, std::span<double const> gradient) const
{
    double sum = 0;
    for (Part const& part : parts_)
    {
        auto const c = static_cast<std::size_t>(part.cell);
        double value = values[c];
        if (!gradient.empty())
            value += part.offset.dot(Vec3(gradient[3 * c], gradient[3 * c + 1], gradient[3 * c + 2]));
        sum += part.area * value;
    }
    return sum / area_;
}

}  // namespace gimdem

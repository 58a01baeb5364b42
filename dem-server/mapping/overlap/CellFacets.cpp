// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/overlap/CellFacets.hpp"

#include <algorithm>
#include <cmath>

namespace gimdem::overlap
{

namespace
{

template <class T>
void append(exec::Buffer<T>& buffer, T const& value)
{
    buffer.resize(buffer.size() + 1);
    buffer[buffer.size() - 1] = value;
}

}  // namespace

CellFacets::CellFacets(PolyMesh const& mesh) : mesh_(mesh), boxes_(cell_boxes(mesh))
{
    auto const& points = mesh.topology().points;
    points_.resize(static_cast<std::int64_t>(points.size()));
    std::ranges::copy(points, points_.host().begin());
    append(corner_offsets_, 0);
    append(facet_offsets_, 0);
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
    {
        add_face(f);
        append(facet_offsets_, static_cast<std::int32_t>(normal_.size()));
    }
}

void CellFacets::add_face(std::int32_t face)
{
    auto const points = mesh_.points_of_face(face);
    if (is_flat_and_convex(face))
        return add_facet(points.data(), static_cast<int>(points.size()),
                         mesh_.face_area(face) * mesh_.face_normal(face));

    Vec3 middle = Vec3::Zero();
    for (std::int32_t const p : points)
        middle += mesh_.point(p);
    middle /= static_cast<double>(points.size());
    auto const middle_number = static_cast<std::int32_t>(points_.size() / 3);
    for (double const x : middle)
        append(points_, x);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
        std::int32_t const triangle[3] = {points[k], points[(k + 1) % points.size()], middle_number};
        Vec3 const a = mesh_.point(triangle[0]), b = mesh_.point(triangle[1]);
        add_facet(triangle, 3, (b - a).cross(middle - a) / 2);
    }
}

Vec3 CellFacets::point(std::int32_t p) const
{
    return {points_[3 * p], points_[3 * p + 1], points_[3 * p + 2]};
}

void CellFacets::add_facet(std::int32_t const* corners, int count, Vec3 const& area)
{
    double const size = area.norm();
    if (!(size > 0)) return;
    for (int k = 0; k < count; ++k)
    {
        Vec3 const way = point(corners[k]) - point(corners[(k + count - 1) % count]);
        double const length = way.norm();
        append(corners_, corners[k]);
        append(edges_, Quad::of(way / length, length));
    }
    append(corner_offsets_, static_cast<std::int32_t>(corners_.size()));
    append(normal_, Quad::of(area / size, size));
}

bool CellFacets::is_flat_and_convex(std::int32_t face) const
{
    auto const points = mesh_.points_of_face(face);
    std::size_t const count = points.size();
    if (count == 3) return true;
    if (count > CellFacetsView::most_corners) return false;
    Vec3 const normal = mesh_.face_normal(face);
    double const tolerance = flatness * std::sqrt(mesh_.face_area(face));
    for (std::size_t k = 0; k < count; ++k)
    {
        Vec3 const a = mesh_.point(points[k]), b = mesh_.point(points[(k + 1) % count]),
                   c = mesh_.point(points[(k + 2) % count]);
        if (std::abs((a - mesh_.point(points[0])).dot(normal)) > tolerance) return false;
        if ((b - a).squaredNorm() == 0) return false;
        if ((b - a).cross(c - b).dot(normal) < -tolerance * (b - a).norm()) return false;
    }
    return true;
}

CellFacetsView CellFacets::view() const
{
    MeshKernelView const mesh = mesh_.view();
    return {points_.view().data,
            facet_offsets_.view().data,
            corner_offsets_.view().data,
            corners_.view().data,
            edges_.view().data,
            normal_.view().data,
            boxes_.view().data,
            mesh.cell_offsets,
            mesh.cell_faces,
            mesh.owner,
            mesh.neighbour,
            mesh.internal_face_count};
}

}  // namespace gimdem::overlap

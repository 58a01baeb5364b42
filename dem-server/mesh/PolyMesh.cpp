// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PolyMesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/Error.hpp"
#include "exec/Sort.hpp"
#include "mesh/GeometryCheck.hpp"

namespace gimdem
{

PolyMesh::PolyMesh(coupling::Mesh topology) : topology_(std::move(topology))
{
    compute_faces();
    list_cell_faces();
    compute_cells();
    check_geometry(*this);
    low_ = Vec3::Constant(std::numeric_limits<double>::infinity());
    high_ = -low_;
    for (std::size_t p = 0; p < topology_.points.size() / 3; ++p)
    {
        low_ = low_.cwiseMin(point(static_cast<std::int32_t>(p)));
        high_ = high_.cwiseMax(point(static_cast<std::int32_t>(p)));
    }
}

coupling::Patch const* PolyMesh::find_patch(std::string const& name) const
{
    for (coupling::Patch const& patch : topology_.patches)
        if (patch.name == name) return &patch;
    return nullptr;
}

Vec3 PolyMesh::point(std::int32_t p) const
{
    double const* const x = topology_.points.data() + 3 * static_cast<std::size_t>(p);
    return {x[0], x[1], x[2]};
}

std::span<std::int32_t const> PolyMesh::points_of_face(std::int32_t face) const
{
    auto const f = static_cast<std::size_t>(face);
    auto const begin = static_cast<std::size_t>(topology_.face_offsets[f]);
    auto const end = static_cast<std::size_t>(topology_.face_offsets[f + 1]);
    return {topology_.face_points.data() + begin, end - begin};
}

std::span<std::int32_t const> PolyMesh::faces_of_cell(std::int32_t cell) const
{
    auto const begin = static_cast<std::size_t>(cell_offsets_[cell]);
    auto const end = static_cast<std::size_t>(cell_offsets_[cell + 1]);
    return cell_faces_.host().subspan(begin, end - begin);
}

MeshKernelView PolyMesh::view() const
{
    return {cells_.view().data,           face_centres_.view().data,  face_normals_.view().data,
            topology_.owner.data(),       topology_.neighbour.data(), cell_offsets_.view().data,
            cell_faces_.view().data,      topology_.points.data(),    topology_.face_offsets.data(),
            topology_.face_points.data(), internal_face_count(),      cell_count()};
}

// A face is a fan of triangles around the mean of its points; centre and area are their area-weighted sums (the
// finite-volume convention, so that volumes and centroids equal the client's to rounding), theory.md (G.1).
void PolyMesh::compute_faces()
{
    face_centres_.resize(face_count());
    face_normals_.resize(face_count());
    for (std::int32_t f = 0; f < face_count(); ++f)
    {
        auto const points = points_of_face(f);
        Vec3 middle = Vec3::Zero();
        for (std::int32_t const p : points)
            middle += point(p);
        middle /= static_cast<double>(points.size());

        Vec3 area = Vec3::Zero();
        Vec3 moment = Vec3::Zero();
        double sum = 0;
        for (std::size_t k = 0; k < points.size(); ++k)
        {
            Vec3 const a = point(points[k]);
            Vec3 const b = point(points[(k + 1) % points.size()]);
            Vec3 const triangle = (b - a).cross(middle - a) / 2;
            area += triangle;
            sum += triangle.norm();
            moment += triangle.norm() * (a + b + middle) / 3;
        }
        double const size = area.norm();
        if (!(size > 0))
            throw UserError(
                fmt::format("face {} near ({:.6g}, {:.6g}, {:.6g}) m has no area (its cells cannot be "
                            "told apart); check the mesh, e.g. with checkMesh",
                            f, middle.x(), middle.y(), middle.z()));
        Vec3 const centre = moment / sum, normal = area / size;
        face_centres_[f] = Quad::of(centre, size);
        face_normals_[f] = Quad::of(normal, warp(f, centre, normal, middle));
    }
}

// Off by less than rounding is flat.
double PolyMesh::warp(std::int32_t face, Vec3 const& centre, Vec3 const& normal, Vec3 const& middle) const
{
    double most = std::abs((middle - centre).dot(normal));
    for (std::int32_t const p : points_of_face(face))
        most = std::max(most, std::abs((point(p) - centre).dot(normal)));
    return most < 1e-12 * std::sqrt(face_centres_[face].w) ? 0 : most;
}

void PolyMesh::list_cell_faces()
{
    cell_offsets_.resize(cell_count() + 1);
    cell_offsets_.fill(0);
    for (std::int32_t const c : topology_.owner)
        ++cell_offsets_[c];
    for (std::int32_t const c : topology_.neighbour)
        ++cell_offsets_[c];
    cell_faces_.resize(exec::exclusive_scan(cell_offsets_.host()));

    exec::Buffer<std::int32_t> next = cell_offsets_;
    for (std::int32_t f = 0; f < face_count(); ++f)
    {
        cell_faces_[next[topology_.owner[static_cast<std::size_t>(f)]]++] = f;
        if (f < internal_face_count()) cell_faces_[next[topology_.neighbour[static_cast<std::size_t>(f)]]++] = f;
    }
}

// A cell is a sum of pyramids from the mean of its face centres to its faces, theory.md (G.2).
void PolyMesh::compute_cells()
{
    cells_.resize(cell_count());
    MeshKernelView const mesh = view();
    for (std::int32_t c = 0; c < cell_count(); ++c)
    {
        auto const faces = faces_of_cell(c);
        if (faces.size() < 4)
            throw UserError(
                fmt::format("cell {} has {} faces (a polyhedron has four or more); check the mesh", c, faces.size()));
        Vec3 middle = Vec3::Zero();
        for (std::int32_t const f : faces)
            middle += face_centre(f);
        middle /= static_cast<double>(faces.size());

        double volume = 0;
        Vec3 moment = Vec3::Zero();
        for (std::int32_t const f : faces)
        {
            double const pyramid = -mesh.distance_outside(f, c, middle) * face_area(f) / 3;
            volume += pyramid;
            moment += pyramid * (0.75 * face_centre(f) + 0.25 * middle);
        }
        if (!(volume > 0))
            throw UserError(
                fmt::format("cell {} near ({:.6g}, {:.6g}, {:.6g}) m has the volume {:.6g} m^3 (it must be "
                            "positive: faces inside out or a degenerate cell); check the mesh, e.g. with "
                            "checkMesh",
                            c, middle.x(), middle.y(), middle.z(), volume));
        cells_[c] = Quad::of(moment / volume, volume);
    }
}

}  // namespace gimdem

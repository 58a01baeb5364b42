// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallGeometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/Error.hpp"

namespace gimdem
{

namespace
{

/// Calls visit(low cell, high cell) ranges of a grid that a box covers.
template <class Visit>
void visit_cells(CellGrid const& grid, Vec3 const& low, Vec3 const& high, Visit&& visit)
{
    std::int32_t const first = grid.cell_of(low);
    std::int32_t const last = grid.cell_of(high);
    auto const x = [&](std::int32_t cell) { return cell % grid.nx; };
    auto const y = [&](std::int32_t cell) { return cell / grid.nx % grid.ny; };
    auto const z = [&](std::int32_t cell) { return cell / grid.nx / grid.ny; };
    for (std::int32_t cz = z(first); cz <= z(last); ++cz)
        for (std::int32_t cy = y(first); cy <= y(last); ++cy)
            for (std::int32_t cx = x(first); cx <= x(last); ++cx)
                visit((cz * grid.ny + cy) * grid.nx + cx);
}

}  // namespace

WallGeometry::WallGeometry(PolyMesh const& mesh, std::vector<std::string> const& also, double reach)
{
    join_planes(mesh, also);
    cut_into_triangles(mesh);
    bin_triangles(mesh, reach);
}

WallView WallGeometry::view() const
{
    return {planes_.view().data, triangles_.view().data, grid_, grid_offsets_.view().data, grid_triangles_.view().data};
}

void WallGeometry::join_planes(PolyMesh const& mesh, std::vector<std::string> const& also)
{
    for (std::string const& name : also)
        if (mesh.find_patch(name) == nullptr)
            throw UserError(
                fmt::format("[walls] also names \"{}\", but the mesh has no such patch; use one of the "
                            "mesh's patch names",
                            name));
    plane_of_face_.assign(static_cast<std::size_t>(mesh.face_count()), -1);
    double const tolerance = 1e-7 * (mesh.high() - mesh.low()).norm();
    for (coupling::Patch const& patch : mesh.topology().patches)
    {
        bool const named = std::find(also.begin(), also.end(), patch.name) != also.end();
        if (patch.kind != coupling::PatchKind::wall && !named) continue;
        for (std::int32_t f = patch.start_face; f < patch.start_face + patch.face_count; ++f)
        {
            Vec3 const normal = -mesh.face_normal(f);
            plane_of_face_[static_cast<std::size_t>(f)] = plane_of(normal, normal.dot(mesh.face_centre(f)), tolerance);
        }
    }
}

// Planes closer than the tolerance (1e-7 of the mesh's size; 1e-10 in 1 - cosine: 3e-6 of a degree of freedom in the
// overlap of a particle) are one.
std::int32_t WallGeometry::plane_of(Vec3 const& normal, double offset, double tolerance)
{
    for (std::int32_t p = plane_count() - 1; p >= 0; --p)
        if (normal.dot(planes_[p].xyz()) > 1 - 1e-10 && std::abs(offset - planes_[p].w) < tolerance) return p;
    planes_.resize(planes_.size() + 1);
    planes_[planes_.size() - 1] = Quad::of(normal, offset);
    return plane_count() - 1;
}

void WallGeometry::cut_into_triangles(PolyMesh const& mesh)
{
    // An edge that two faces of one plane share is inside the plane; any other is its rim.
    std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, int> uses;
    auto const edge_key = [](std::int32_t plane, std::int32_t a, std::int32_t b)
    { return std::tuple(plane, std::min(a, b), std::max(a, b)); };
    auto const visit_edges = [&](auto&& visit)
    {
        for (std::int32_t f = mesh.internal_face_count(); f < mesh.face_count(); ++f)
        {
            std::int32_t const plane = plane_of_face_[static_cast<std::size_t>(f)];
            auto const points = mesh.points_of_face(f);
            for (std::size_t k = 0; plane >= 0 && k < points.size(); ++k)
                visit(f, plane, points[k], points[(k + 1) % points.size()]);
        }
    };
    std::int64_t count = 0;
    visit_edges(
        [&](std::int32_t, std::int32_t plane, std::int32_t a, std::int32_t b)
        {
            ++uses[edge_key(plane, a, b)];
            ++count;
        });
    triangles_.resize(count);
    std::int64_t t = 0;
    visit_edges(
        [&](std::int32_t f, std::int32_t plane, std::int32_t a, std::int32_t b)
        {
            triangles_[t++] = {Quad::of(mesh.point(a), 0), Quad::of(mesh.point(b), 0), Quad::of(mesh.face_centre(f), 0),
                               plane, uses[edge_key(plane, a, b)] == 1};
        });
    std::stable_sort(triangles_.host().begin(), triangles_.host().end(),
                     [](WallTriangle const& a, WallTriangle const& b) { return a.plane < b.plane; });
}

void WallGeometry::bin_triangles(PolyMesh const& mesh, double reach)
{
    Vec3 const margin = Vec3::Constant(reach);
    grid_ = CellGrid::over(mesh.low() - margin, mesh.high() + margin, 2 * reach, 4'000'000);
    auto const visit = [&](auto&& action)
    {
        for (std::int64_t t = 0; t < triangles_.size(); ++t)
        {
            WallTriangle const& triangle = triangles_[t];
            Vec3 const a = triangle.a.xyz(), b = triangle.b.xyz(), c = triangle.c.xyz();
            visit_cells(grid_, a.cwiseMin(b).cwiseMin(c) - margin, a.cwiseMax(b).cwiseMax(c) + margin,
                        [&](std::int32_t cell) { action(cell, static_cast<std::int32_t>(t)); });
        }
    };
    grid_offsets_.resize(grid_.count() + 1);
    grid_offsets_.fill(0);
    visit([&](std::int32_t cell, std::int32_t) { ++grid_offsets_[cell]; });
    grid_triangles_.resize(exec::exclusive_scan(grid_offsets_.host()));
    exec::Buffer<std::int32_t> next = grid_offsets_;
    visit([&](std::int32_t cell, std::int32_t t) { grid_triangles_[next[cell]++] = t; });
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallGeometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "walls/StlFile.hpp"
#include "walls/SurfaceCheck.hpp"
#include "walls/SurfacePlanes.hpp"

namespace gimdem
{

namespace
{

Vec3 vector(Triple const& t)
{
    return {t[0], t[1], t[2]};
}

Constant3 constant(Vec3 const& v)
{
    return {v.x(), v.y(), v.z()};
}

struct Box
{
    Vec3 low, high;
};

Box box_of(WallTriangle const& t)
{
    Vec3 const a = t.a.xyz(), b = t.b.xyz(), c = t.c.xyz();
    return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

/// Calls visit(cell) for the boxes of a grid within `reach` of a triangle: those that its bounding box covers, less
/// those on either side of its plane.
template <class Visit>
void visit_cells(CellGrid const& grid, WallTriangle const& triangle, double reach, Visit&& visit)
{
    Box const box = box_of(triangle);
    std::int32_t const first = grid.cell_of(box.low - Vec3::Constant(reach));
    std::int32_t const last = grid.cell_of(box.high + Vec3::Constant(reach));
    auto const x = [&](std::int32_t cell) { return cell % grid.nx; };
    auto const y = [&](std::int32_t cell) { return cell / grid.nx % grid.ny; };
    auto const z = [&](std::int32_t cell) { return cell / grid.nx / grid.ny; };
    Vec3 const a = triangle.a.xyz();
    Vec3 const normal = (triangle.b.xyz() - a).cross(triangle.c.xyz() - a).stableNormalized();
    // A little more than half a box's diagonal, against rounding.
    double const farthest = reach + 0.87 * grid.cell_size;
    for (std::int32_t cz = z(first); cz <= z(last); ++cz)
        for (std::int32_t cy = y(first); cy <= y(last); ++cy)
            for (std::int32_t cx = x(first); cx <= x(last); ++cx)
            {
                Vec3 const centre = grid.origin.vec() + grid.cell_size * Vec3(cx + 0.5, cy + 0.5, cz + 0.5);
                if (std::abs(normal.dot(centre - a)) <= farthest) visit((cz * grid.ny + cy) * grid.nx + cx);
            }
}

}  // namespace

WallGeometry::WallGeometry(PolyMesh const& mesh, std::vector<std::string> const& also, double reach,
                           std::vector<WallItemSettings> const& items)
    : reach_(reach)
{
    add_mesh(mesh, also);
    for (WallItemSettings const& item : items)
        add_item(item);
}

WallGeometry::WallGeometry(std::vector<WallItemSettings> const& items, double reach) : reach_(reach)
{
    for (WallItemSettings const& item : items)
        add_item(item);
}

WallView WallGeometry::view() const
{
    return {surfaces_.view().data, triangles_.view().data,    bodies_.view().data,
            body_count(),          grid_offsets_.view().data, grid_triangles_.view().data};
}

void WallGeometry::add_item(WallItemSettings const& item)
{
    begin_body("wall \"" + item.name + '"', item.material, WallMotion(item));
    if (item.shape == "plane")
    {
        Vec3 const normal = vector(item.normal).normalized();
        add_surface(SurfaceKind::plane, normal, normal.dot(vector(item.point)));
    }
    else if (item.shape == "cylinder")
    {
        WallSurface& tube = add_surface(SurfaceKind::cylinder, vector(item.axis).normalized(), item.radius);
        tube.point = Quad::of(vector(item.point), item.length);
        tube.endless = !(item.length > 0);
        tube.inside = item.inside;
    }
    else
    {
        SurfaceMesh surface = read_stl(item.file, item.scale);
        check_surface(surface, item.file.string(), item.open);
        if (item.inside)
            for (SurfaceMesh::Triangle& triangle : surface.triangles)
                std::swap(triangle[1], triangle[2]);
        add_surfaces(surface, item);
        closed_.back() = !item.open;
    }
    end_body();
}

void WallGeometry::add_surfaces(SurfaceMesh const& surface, WallItemSettings const& item)
{
    SurfacePlanes const planes = find_planes(surface, item.open);
    std::int32_t const first = plane_count();
    for (std::size_t p = 0; p < planes.planes.size(); ++p)
    {
        WallSurface& s = add_surface(SurfaceKind::facets, planes.planes[p].xyz(), planes.planes[p].w);
        s.slack = planes.slack[p];
        s.patch = first + planes.patch_of_plane[p];
        s.two_sided = item.open;
        s.inside = item.inside;
        s.behind = 0.5;  // behind a thin solid is its other side
    }
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
        triangles_.resize(triangles_.size() + 1);
        triangles_[triangles_.size() - 1] = {Quad::of(surface.point(t, 0), 0), Quad::of(surface.point(t, 1), 0),
                                             Quad::of(surface.point(t, 2), 0), first + planes.plane_of_triangle[t],
                                             planes.rim_of_triangle[t]};
    }
}

void WallGeometry::begin_body(std::string const& name, std::string const& material, WallMotion const& motion)
{
    bodies_.resize(bodies_.size() + 1);
    WallBody& body = bodies_[bodies_.size() - 1];
    body = {};
    body.surface = plane_count();
    body.moves = motion.moves();
    names_.push_back(name);
    materials_.push_back(material);
    closed_.push_back(false);
    motions_.push_back(motion);
}

WallSurface& WallGeometry::add_surface(SurfaceKind kind, Vec3 const& direction, double offset)
{
    surfaces_.resize(surfaces_.size() + 1);
    WallSurface& surface = surfaces_[surfaces_.size() - 1];
    surface = {};
    surface.kind = kind;
    surface.normal = Quad::of(direction, offset);
    surface.body = body_count() - 1;
    surface.patch = plane_count() - 1;
    surface.behind = 1;
    return surface;
}

/// Puts the triangles that were added since begin_body() in order, tells each surface which are its own, bins them.
void WallGeometry::end_body()
{
    WallBody& body = bodies_[bodies_.size() - 1];
    body.surface_end = plane_count();
    std::int64_t first = triangles_.size();
    while (first > 0 && triangles_[first - 1].plane >= body.surface)
        --first;
    std::stable_sort(triangles_.host().begin() + first, triangles_.host().end(),
                     [](WallTriangle const& a, WallTriangle const& b) { return a.plane < b.plane; });
    for (std::int64_t t = first; t < triangles_.size(); ++t)
    {
        WallSurface& surface = surfaces_[triangles_[t].plane];
        if (surface.triangle_count++ == 0) surface.triangle = static_cast<std::int32_t>(t);
    }
    body.has_triangles = first < triangles_.size();
    if (body.has_triangles) bin_triangles(body, first);
}

void WallGeometry::bin_triangles(WallBody& body, std::int64_t first_triangle)
{
    Box all = box_of(triangles_[first_triangle]);
    double size = 0;
    for (std::int64_t t = first_triangle; t < triangles_.size(); ++t)
    {
        Box const box = box_of(triangles_[t]);
        all = {all.low.cwiseMin(box.low), all.high.cwiseMax(box.high)};
        size += (box.high - box.low).maxCoeff() / static_cast<double>(triangles_.size() - first_triangle);
    }
    Vec3 const margin = Vec3::Constant(reach_);
    body.low = constant(all.low - margin);
    body.high = constant(all.high + margin);
    // Boxes as large as what is within reach, but not much larger than triangles that are smaller than that.
    double const box_size = std::clamp(size, reach_, 2 * reach_);
    body.grid = CellGrid::over(body.low.vec(), body.high.vec(), box_size, 4'000'000);

    std::int64_t const boxes = body.grid.count();
    exec::Buffer<std::int32_t> offsets(boxes + 1);
    offsets.fill(0);
    auto const visit = [&](auto&& action)
    {
        for (std::int64_t t = first_triangle; t < triangles_.size(); ++t)
            visit_cells(body.grid, triangles_[t], reach_,
                        [&](std::int32_t cell) { action(cell, static_cast<std::int32_t>(t)); });
    };
    visit([&](std::int32_t cell, std::int32_t) { ++offsets[cell]; });
    std::int64_t const members = exec::exclusive_scan(offsets.host());
    auto const before = static_cast<std::int32_t>(grid_triangles_.size());
    body.grid_begin = grid_offsets_.size();
    grid_offsets_.resize(body.grid_begin + boxes + 1);
    for (std::int64_t k = 0; k <= boxes; ++k)
        grid_offsets_[body.grid_begin + k] = before + offsets[k];
    grid_triangles_.resize(before + members);
    visit([&](std::int32_t cell, std::int32_t t) { grid_triangles_[before + offsets[cell]++] = t; });
}

std::span<WallTriangle const> WallGeometry::triangles_of(std::int32_t body) const
{
    WallBody const& b = bodies_[body];
    if (!b.has_triangles) return {};
    WallSurface const &first = surfaces_[b.surface], &last = surfaces_[b.surface_end - 1];
    return triangles_.host().subspan(static_cast<std::size_t>(first.triangle),
                                     static_cast<std::size_t>(last.triangle + last.triangle_count - first.triangle));
}

std::string WallGeometry::description() const
{
    std::string text;
    // Rounded, so that meshes of the same vessel have the same description.
    auto const add = [&](auto... values) { ((text += fmt::format("{} ", std::round(values * 1e8) + 0.0)), ...); };
    for (WallSurface const& s : surfaces_.host())
    {
        add(s.normal.x, s.normal.y, s.normal.z, s.normal.w);
        if (s.kind == SurfaceKind::facets && s.body == mesh_body_) continue;
        add(s.point.x, s.point.y, s.point.z, s.point.w);
        text += fmt::format("{} {} {} {} ", static_cast<int>(s.kind), s.inside, s.two_sided, material(s.body));
        WallPose const pose = motion(s.body).at(0);
        add(pose.shift.x, pose.shift.y, pose.shift.z);
        for (std::int32_t t = s.triangle; t < s.triangle + s.triangle_count; ++t)
            for (Quad const& corner : {triangles_[t].a, triangles_[t].b, triangles_[t].c})
                add(corner.x, corner.y, corner.z);
    }
    return text;
}

}  // namespace gimdem

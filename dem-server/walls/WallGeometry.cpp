// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallGeometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "walls/StlFile.hpp"
#include "walls/SurfaceCheck.hpp"
#include "walls/SurfacePlanes.hpp"
#include "walls/TriangleBins.hpp"

namespace gimdem
{

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
        Vec3 const normal = vec3(item.normal).normalized();
        add_surface(SurfaceKind::plane, normal, normal.dot(vec3(item.point)));
    }
    else if (item.shape == "cylinder")
    {
        WallSurface& tube = add_surface(SurfaceKind::cylinder, vec3(item.axis).normalized(), item.radius);
        tube.point = Quad::of(vec3(item.point), item.length);
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
    TriangleBins const bins(triangles_.host().subspan(static_cast<std::size_t>(first_triangle)), reach_);
    body.low = constant3(bins.low());
    body.high = constant3(bins.high());
    body.grid = bins.grid();
    body.grid_begin = grid_offsets_.size();
    std::int64_t const before = grid_triangles_.size();
    grid_offsets_.resize(body.grid_begin + std::ssize(bins.offsets()));
    for (std::int64_t k = body.grid_begin; std::int32_t const offset : bins.offsets())
        grid_offsets_[k++] = static_cast<std::int32_t>(before) + offset;
    grid_triangles_.resize(before + std::ssize(bins.members()));
    for (std::int64_t k = before; std::int32_t const triangle : bins.members())
        grid_triangles_[k++] = static_cast<std::int32_t>(first_triangle) + triangle;
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

// SPDX-License-Identifier: BSD-3-Clause
/// The walls that are boundary faces of the client's mesh.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/Error.hpp"
#include "walls/SurfacePlanes.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem
{

namespace
{

/// Calls visit(face, plane, point a, point b) for every edge of every face that is a wall.
template <class Visit>
void visit_edges(PolyMesh const& mesh, std::vector<std::int32_t> const& plane_of_face, Visit&& visit)
{
    for (std::int32_t f = mesh.internal_face_count(); f < mesh.face_count(); ++f)
    {
        std::int32_t const plane = plane_of_face[static_cast<std::size_t>(f)];
        auto const points = mesh.points_of_face(f);
        for (std::size_t k = 0; plane >= 0 && k < points.size(); ++k)
            visit(f, plane, points[k], points[(k + 1) % points.size()]);
    }
}

}  // namespace

void WallGeometry::add_mesh(PolyMesh const& mesh, std::vector<std::string> const& also)
{
    mesh_body_ = body_count();
    begin_body("the walls of the mesh", "", WallMotion());
    join_planes(mesh, also);
    cut_into_triangles(mesh);
    join_patches(mesh);
    end_body();
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
    {
        Quad const plane = surfaces_[p].normal;
        double const apart = std::abs(offset - plane.w);
        if (normal.dot(plane.xyz()) <= 1 - 1e-10 || apart >= tolerance) continue;
        surfaces_[p].slack = std::max(surfaces_[p].slack, apart);
        return p;
    }
    add_surface(SurfaceKind::facets, normal, offset);
    return plane_count() - 1;
}

void WallGeometry::cut_into_triangles(PolyMesh const& mesh)
{
    // An edge that two faces of one plane share is inside the plane; any other is its rim.
    std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, int> uses;
    auto const edge_key = [](std::int32_t plane, std::int32_t a, std::int32_t b)
    { return std::tuple(plane, std::min(a, b), std::max(a, b)); };
    std::int64_t count = 0;
    visit_edges(mesh, plane_of_face_,
                [&](std::int32_t, std::int32_t plane, std::int32_t a, std::int32_t b)
                {
                    ++uses[edge_key(plane, a, b)];
                    ++count;
                });
    triangles_.resize(count);
    std::int64_t t = 0;
    visit_edges(mesh, plane_of_face_,
                [&](std::int32_t f, std::int32_t plane, std::int32_t a, std::int32_t b)
                {
                    bool const is_rim = uses[edge_key(plane, a, b)] == 1;
                    triangles_[t++] = {Quad::of(mesh.point(a), 0), Quad::of(mesh.point(b), 0),
                                       Quad::of(mesh.face_centre(f), 0), plane, static_cast<std::uint8_t>(is_rim)};
                });
}

void WallGeometry::join_patches(PolyMesh const& mesh)
{
    PatchJoiner patches(plane_count());
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> plane_at;
    visit_edges(mesh, plane_of_face_,
                [&](std::int32_t, std::int32_t plane, std::int32_t a, std::int32_t b)
                {
                    auto const [first, is_new] = plane_at.emplace(std::minmax(a, b), plane);
                    if (!is_new)
                        patches.join(first->second, plane, surfaces_[first->second].normal.xyz(),
                                     surfaces_[plane].normal.xyz(), false);
                });
    for (std::int32_t p = 0; p < plane_count(); ++p)
        surfaces_[p].patch = patches.patch_of(p);
}

}  // namespace gimdem

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

/// Whether a point of a face is farther from its plane than the tolerance [m].
bool is_warped(PolyMesh const& mesh, std::int32_t face, double tolerance)
{
    auto const points = mesh.points_of_face(face);
    return std::any_of(points.begin(), points.end(),
                       [&](std::int32_t p)
                       {
                           Vec3 const from = mesh.point(p) - mesh.face_centre(face);
                           return std::abs(from.dot(mesh.face_normal(face))) > tolerance;
                       });
}

/// Unit normal of the triangle that edge k of a face makes with its centre, into the mesh; of the face, if there is no
/// such triangle.
Vec3 normal_at_edge(PolyMesh const& mesh, std::int32_t face, std::size_t k)
{
    auto const points = mesh.points_of_face(face);
    Vec3 const centre = mesh.face_centre(face);
    Vec3 const a = mesh.point(points[k]) - centre, b = mesh.point(points[(k + 1) % points.size()]) - centre;
    Vec3 const area = b.cross(a);
    return area.norm() > 1e-12 * (a - b).squaredNorm() ? area.normalized() : Vec3(-mesh.face_normal(face));
}

}  // namespace

/// Calls visit(face, plane, point a, point b) for every edge of every face that is a wall.
template <class Visit>
void WallGeometry::visit_edges(PolyMesh const& mesh, Visit&& visit) const
{
    for (std::int32_t f = mesh.internal_face_count(); f < mesh.face_count(); ++f)
    {
        auto const [plane, warped] = planes_of_face_[static_cast<std::size_t>(f)];
        auto const points = mesh.points_of_face(f);
        for (std::size_t k = 0; plane >= 0 && k < points.size(); ++k)
            visit(f, warped ? plane + static_cast<std::int32_t>(k) : plane, points[k], points[(k + 1) % points.size()]);
    }
}

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
    planes_of_face_.assign(static_cast<std::size_t>(mesh.face_count()), {});
    double const tolerance = 1e-7 * (mesh.high() - mesh.low()).norm();
    for (coupling::Patch const& patch : mesh.topology().patches)
    {
        bool const named = std::find(also.begin(), also.end(), patch.name) != also.end();
        if (patch.kind != coupling::PatchKind::wall && !named) continue;
        for (std::int32_t f = patch.start_face; f < patch.start_face + patch.face_count; ++f)
            planes_of_face_[static_cast<std::size_t>(f)] = add_planes(mesh, f, tolerance);
    }
}

WallGeometry::FacePlanes WallGeometry::add_planes(PolyMesh const& mesh, std::int32_t face, double tolerance)
{
    Vec3 const centre = mesh.face_centre(face), normal = -mesh.face_normal(face);
    if (!is_warped(mesh, face, tolerance)) return {plane_of(normal, normal.dot(centre), tolerance), false};
    for (std::size_t k = 0; k < mesh.points_of_face(face).size(); ++k)
    {
        Vec3 const own = normal_at_edge(mesh, face, k);
        add_surface(SurfaceKind::facets, own, own.dot(centre));
    }
    return {plane_count() - static_cast<std::int32_t>(mesh.points_of_face(face).size()), true};
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
    visit_edges(mesh,
                [&](std::int32_t, std::int32_t plane, std::int32_t a, std::int32_t b)
                {
                    ++uses[edge_key(plane, a, b)];
                    ++count;
                });
    triangles_.resize(count);
    std::int64_t t = 0;
    visit_edges(mesh,
                [&](std::int32_t f, std::int32_t plane, std::int32_t a, std::int32_t b)
                {
                    // A triangle of a warped face is a plane of its own.
                    bool const is_rim = uses[edge_key(plane, a, b)] == 1;
                    int const rim = planes_of_face_[static_cast<std::size_t>(f)].warped ? 0b111 : int(is_rim);
                    triangles_[t++] = {Quad::of(mesh.point(a), 0), Quad::of(mesh.point(b), 0),
                                       Quad::of(mesh.face_centre(f), 0), plane, static_cast<std::uint8_t>(rim)};
                });
}

void WallGeometry::join_patches(PolyMesh const& mesh)
{
    PatchJoiner patches(plane_count());
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> plane_at;
    auto const join = [&](std::int32_t one, std::int32_t other)
    { patches.join(one, other, surfaces_[one].normal.xyz(), surfaces_[other].normal.xyz(), false); };
    visit_edges(mesh,
                [&](std::int32_t f, std::int32_t plane, std::int32_t a, std::int32_t b)
                {
                    auto const [first, is_new] = plane_at.emplace(std::minmax(a, b), plane);
                    if (!is_new) join(first->second, plane);
                    std::int32_t const of_face = planes_of_face_[static_cast<std::size_t>(f)].first;
                    if (plane > of_face) join(plane - 1, plane);  // side by side in a warped face
                });
    for (std::int32_t p = 0; p < plane_count(); ++p)
        surfaces_[p].patch = patches.patch_of(p);
}

}  // namespace gimdem

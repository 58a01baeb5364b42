// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/GeometryCheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "core/Error.hpp"

namespace gimdem
{

namespace
{

std::string place(Vec3 const& x)
{
    return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z());
}

/// Cube root of the smaller one of a face's cells [m].
double size_of_cells(PolyMesh const& mesh, std::int32_t face)
{
    auto const f = static_cast<std::size_t>(face);
    double smaller = mesh.volume(mesh.topology().owner[f]);
    if (face < mesh.internal_face_count()) smaller = std::min(smaller, mesh.volume(mesh.topology().neighbour[f]));
    return std::cbrt(smaller);
}

void check_warp(PolyMesh const& mesh)
{
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
    {
        double const warp = mesh.face_warp(f) / size_of_cells(mesh, f);
        if (warp > largest_face_warp)
            throw UserError(fmt::format(
                "face {} of cell {} near {} is not planar: its points are off its plane by {:.3g} of the cube root of "
                "the smaller of its cells' volumes (at most {:g}, or planes say nothing of where the cell ends); split "
                "the face or smooth the mesh, and see checkMesh -allGeometry",
                f, mesh.topology().owner[static_cast<std::size_t>(f)], place(mesh.face_centre(f)), warp,
                largest_face_warp));
    }
}

void check_cell(PolyMesh const& mesh, std::int32_t cell)
{
    Vec3 opening = Vec3::Zero();
    double surface = 0;
    for (std::int32_t const f : mesh.faces_of_cell(cell))
    {
        bool const is_owner = mesh.topology().owner[static_cast<std::size_t>(f)] == cell;
        opening += (is_owner ? 1 : -1) * mesh.face_area(f) * mesh.face_normal(f);
        surface += mesh.face_area(f);
    }
    if (opening.norm() > largest_opening * surface)
        throw UserError(fmt::format(
            "cell {} near {} is open: its face areas sum to {:.3g} of its surface (zero for a closed cell: a face is "
            "missing or turned round); check the mesh, e.g. with checkMesh",
            cell, place(mesh.centroid(cell)), opening.norm() / surface));
    if (mesh.volume(cell) < smallest_cell_volume * std::pow(surface, 1.5))
        throw UserError(fmt::format(
            "cell {} near {} has no volume to speak of: {:.3g} m^3 with a surface of {:.3g} m^2 (it is collapsed); "
            "check the mesh, e.g. with checkMesh",
            cell, place(mesh.centroid(cell)), mesh.volume(cell), surface));
}

/// Points of a face in rising order.
std::vector<std::int32_t> sorted_points(PolyMesh const& mesh, std::int32_t face)
{
    auto const points = mesh.points_of_face(face);
    std::vector<std::int32_t> sorted(points.begin(), points.end());
    std::ranges::sort(sorted);
    return sorted;
}

// Two boundary faces of two cells may have the same points: a baffle.
void check_pair(PolyMesh const& mesh, std::int32_t a, std::int32_t b)
{
    auto const owner = [&](std::int32_t f) { return mesh.topology().owner[static_cast<std::size_t>(f)]; };
    bool const is_baffle = a >= mesh.internal_face_count() && b >= mesh.internal_face_count() && owner(a) != owner(b);
    if (is_baffle || sorted_points(mesh, a) != sorted_points(mesh, b)) return;
    throw UserError(
        fmt::format("faces {} and {} near {} have the same points, of cells {} and {} (a face has one owner and one "
                    "neighbour; only "
                    "two boundary faces of two cells, a baffle, may coincide); check the mesh, e.g. with checkMesh",
                    a, b, place(mesh.face_centre(a)), owner(a), owner(b)));
}

// Faces with the same points have the same sum of squares of their numbers: candidates are those
// alone.
void check_double_faces(PolyMesh const& mesh)
{
    std::vector<std::int64_t> key(static_cast<std::size_t>(mesh.face_count()));
    std::vector<std::int32_t> order(key.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::int32_t const f : order)
    {
        auto const points = mesh.points_of_face(f);
        key[static_cast<std::size_t>(f)] =
            std::accumulate(points.begin(), points.end(), std::int64_t{0},
                            [](std::int64_t sum, std::int32_t p) { return sum + std::int64_t{p} * p; });
    }
    auto const key_of = [&](std::int32_t f) { return key[static_cast<std::size_t>(f)]; };
    std::ranges::stable_sort(order, {}, key_of);
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t k = i + 1; k < order.size() && key_of(order[k]) == key_of(order[i]); ++k)
            check_pair(mesh, order[i], order[k]);
}

}  // namespace

void check_geometry(PolyMesh const& mesh)
{
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        check_cell(mesh, c);
    check_warp(mesh);
    check_double_faces(mesh);
}

}  // namespace gimdem

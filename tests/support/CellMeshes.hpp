// SPDX-License-Identifier: BSD-3-Clause
/// Meshes of any cells, put together from lists of their faces: tetrahedra, Voronoi cells, warped hexahedra.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "exec/Vector.hpp"
#include "gimdem/coupling/Types.hpp"

namespace gimdem::test
{

/// Cells as lists of faces, faces as numbers of points in order, so that their normals leave the cell.
struct CellList
{
    using Face = std::vector<int>;
    std::vector<Vec3> points;
    std::vector<std::vector<Face>> cells;

    /// Faces with the same points are one. All that are left are the patch "sides", of walls.
    coupling::Mesh mesh() const
    {
        struct Place
        {
            int owner;
            int neighbour;
            Face face;
        };
        std::map<Face, Place> faces;
        for (int c = 0; c < static_cast<int>(cells.size()); ++c)
            for (Face const& face : cells[static_cast<std::size_t>(c)])
            {
                Face key = face;
                std::ranges::sort(key);
                auto const [at, is_new] = faces.try_emplace(key, Place{c, -1, face});
                if (!is_new) at->second.neighbour = c;
            }
        coupling::Mesh mesh;
        mesh.cell_count = static_cast<std::int32_t>(cells.size());
        mesh.face_offsets = {0};
        for (Vec3 const& x : points)
            mesh.points.insert(mesh.points.end(), x.begin(), x.end());
        for (bool const internal : {true, false})
            for (auto const& [key, place] : faces)
            {
                if ((place.neighbour >= 0) != internal) continue;
                mesh.face_points.insert(mesh.face_points.end(), place.face.begin(), place.face.end());
                mesh.face_offsets.push_back(static_cast<std::int32_t>(mesh.face_points.size()));
                mesh.owner.push_back(place.owner);
                if (internal) mesh.neighbour.push_back(place.neighbour);
            }
        auto const internal = static_cast<std::int32_t>(mesh.neighbour.size());
        auto const all = static_cast<std::int32_t>(mesh.owner.size());
        mesh.patches.push_back({"sides", coupling::PatchKind::wall, internal, all - internal});
        return mesh;
    }
};

/// The six faces of a hexahedron whose corner k is at the upper end of x, y, z where bit 0, 1, 2 of k is set.
inline std::vector<CellList::Face> hexahedron(std::array<int, 8> const& p)
{
    return {{p[0], p[4], p[6], p[2]}, {p[1], p[3], p[7], p[5]}, {p[0], p[1], p[5], p[4]},
            {p[2], p[6], p[7], p[3]}, {p[0], p[2], p[3], p[1]}, {p[4], p[5], p[7], p[6]}};
}

/// The four faces of a tetrahedron.
inline std::vector<CellList::Face> tetrahedron(std::vector<Vec3> const& x, std::array<int, 4> p)
{
    auto const at = [&](int k) { return x[static_cast<std::size_t>(p[static_cast<std::size_t>(k)])]; };
    if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0) std::swap(p[2], p[3]);
    return {{p[0], p[2], p[1]}, {p[0], p[1], p[3]}, {p[1], p[2], p[3]}, {p[0], p[3], p[2]}};
}

/// A box of n^3 boxes of the given edges, with what becomes of each: add(corners, cells).
template <class Add>
CellList box_of(int n, Vec3 const& edges, Add add)
{
    CellList list;
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i)
                list.points.push_back(edges.cwiseProduct(Vec3(i, j, k)));
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                std::array<int, 8> corners;
                for (int q = 0; q < 8; ++q)
                    corners[static_cast<std::size_t>(q)] =
                        i + (q & 1) + (n + 1) * (j + (q >> 1 & 1) + (n + 1) * (k + (q >> 2)));
                add(corners, list);
            }
    return list;
}

inline CellList hexahedra(int n, Vec3 const& edges)
{
    return box_of(n, edges,
                  [](std::array<int, 8> const& corners, CellList& list) { list.cells.push_back(hexahedron(corners)); });
}

/// Six tetrahedra for each box, around its diagonal.
inline CellList tetrahedra(int n, Vec3 const& edges)
{
    return box_of(n, edges,
                  [](std::array<int, 8> const& c, CellList& list)
                  {
                      for (auto const& [a, b] :
                           std::array<std::array<std::size_t, 2>, 6>{{{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}})
                          list.cells.push_back(tetrahedron(list.points, {c[0], c[a], c[b], c[7]}));
                  });
}

/// Moves all points but those of the box's surface by up to `amount` of the edges: warped faces.
inline CellList shaken(CellList list, double amount, unsigned seed = 3)
{
    Vec3 low = list.points[0], high = list.points[0];
    for (Vec3 const& x : list.points)
    {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    double const edge = std::cbrt((high - low).prod() / static_cast<double>(list.cells.size()));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-amount * edge, amount * edge);
    for (Vec3& x : list.points)
        if ((x - low).minCoeff() > 1e-9 * edge && (high - x).minCoeff() > 1e-9 * edge)
            x += Vec3(uniform(random), uniform(random), uniform(random));
    return list;
}

namespace detail
{

using Polygon = std::vector<Vec3>;

/// The part of a polygon with x . normal <= level; the points on the cut are appended to `rim`.
inline Polygon clip(Polygon const& polygon, Vec3 const& normal, double level, std::vector<Vec3>& rim)
{
    Polygon inside;
    for (std::size_t k = 0; k < polygon.size(); ++k)
    {
        Vec3 const a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        double const at_a = a.dot(normal) - level, at_b = b.dot(normal) - level;
        if (at_a <= 0) inside.push_back(a);
        if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0))
        {
            inside.push_back(a + (b - a) * (at_a / (at_a - at_b)));
            rim.push_back(inside.back());
        }
    }
    return inside;
}

/// Points of a convex polygon in order, counterclockwise around its normal, each once.
inline Polygon in_order(std::vector<Vec3> points, Vec3 const& normal)
{
    Vec3 middle = Vec3::Zero();
    for (Vec3 const& x : points)
        middle += x / static_cast<double>(points.size());
    Vec3 const u = (points[0] - middle).normalized(), v = normal.cross(u);
    auto const angle = [&](Vec3 const& x) { return std::atan2(v.dot(x - middle), u.dot(x - middle)); };
    std::ranges::sort(points, {}, angle);
    Polygon polygon;
    for (Vec3 const& x : points)
        if (polygon.empty() || ((x - polygon.back()).norm() > 1e-9 && (x - polygon.front()).norm() > 1e-9))
            polygon.push_back(x);
    return polygon;
}

/// A convex cell cut by a plane.
inline void cut(std::vector<Polygon>& cell, Vec3 const& normal, double level)
{
    std::vector<Vec3> rim;
    std::vector<Polygon> kept;
    for (Polygon const& face : cell)
        if (Polygon part = clip(face, normal, level, rim); part.size() >= 3) kept.push_back(std::move(part));
    if (rim.size() >= 3) kept.push_back(in_order(rim, normal));
    cell = std::move(kept);
}

}  // namespace detail

/// Voronoi cells of random points in a box of the given edges, one in each box of a lattice: convex polyhedra of about
/// 15 faces.
inline CellList voronoi_cells(int n, Vec3 const& edges, unsigned seed = 5)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.1, 0.9);
    std::vector<Vec3> seeds;
    for (int i = 0; i < n * n * n; ++i)
        seeds.push_back(Vec3(i % n + uniform(random), i / n % n + uniform(random), i / n / n + uniform(random)) / n);

    CellList list;
    auto const number_of = [&](Vec3 const& x)
    {
        for (std::size_t p = 0; p < list.points.size(); ++p)
            if ((list.points[p] - x).cwiseAbs().maxCoeff() < 1e-9) return static_cast<int>(p);
        list.points.push_back(x);
        return static_cast<int>(list.points.size()) - 1;
    };
    for (Vec3 const& x : seeds)
    {
        std::vector<detail::Polygon> cell;
        for (auto const& face : hexahedron({0, 1, 2, 3, 4, 5, 6, 7}))
        {
            detail::Polygon polygon;
            for (int const q : face)
                polygon.emplace_back(q & 1, q >> 1 & 1, q >> 2);
            cell.push_back(polygon);
        }
        for (Vec3 const& y : seeds)
            if (&x != &y && (y - x).norm() < 4.0 / n)
                detail::cut(cell, (y - x).normalized(), (y - x).normalized().dot((x + y) / 2));
        std::vector<CellList::Face> faces;
        for (detail::Polygon const& polygon : cell)
        {
            CellList::Face face;
            for (Vec3 const& p : polygon)
                face.push_back(number_of(p));
            faces.push_back(face);
        }
        list.cells.push_back(faces);
    }
    for (Vec3& p : list.points)
        p = p.cwiseProduct(edges);
    return list;
}

}  // namespace gimdem::test

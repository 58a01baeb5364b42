// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/MeshGeometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace gimdem::conformance
{
namespace
{

using coupling::Mesh;
using Vector = std::array<double, 3>;

/// As the server of particles has it, theory.md (G.2a).
double constexpr largest_opening = 1e-6;

Vector operator-(Vector const& a, Vector const& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector& operator+=(Vector& a, Vector const& b)
{
    for (std::size_t k = 0; k < 3; ++k)
        a[k] += b[k];
    return a;
}
Vector operator*(double factor, Vector const& a)
{
    return {factor * a[0], factor * a[1], factor * a[2]};
}
Vector cross(Vector const& a, Vector const& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(Vector const& a, Vector const& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::vector<Vector> points_of(Mesh const& mesh, std::size_t face)
{
    std::vector<Vector> points;
    for (auto k = mesh.face_offsets[face]; k < mesh.face_offsets[face + 1]; ++k)
    {
        double const* const x =
            &mesh.points[3 * static_cast<std::size_t>(mesh.face_points[static_cast<std::size_t>(k)])];
        points.push_back({x[0], x[1], x[2]});
    }
    return points;
}

Vector mean(std::vector<Vector> const& points)
{
    Vector sum{};
    for (Vector const& point : points)
        sum += point;
    return 1.0 / static_cast<double>(points.size()) * sum;
}

/// Sums over the faces of a cell.
struct CellSums
{
    Vector area{};         ///< leaving the cell [m^2]
    double magnitude = 0;  ///< of the areas [m^2]
    double volume = 0;     ///< divergence theorem [m^3]
};

/// Adds one face to a cell; sign: 1 if its normal leaves the cell. origin: any point near the mesh, against rounding.
void add_face(CellSums& cell, std::vector<Vector> const& points, double sign, Vector const& origin)
{
    Vector const centre = mean(points);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
        Vector const& a = points[k];
        Vector const& b = points[(k + 1) % points.size()];
        Vector const area = 0.5 * sign * cross(a - centre, b - centre);
        cell.area += area;
        cell.magnitude += std::sqrt(dot(area, area));
        cell.volume += dot(mean({centre, a, b}) - origin, area) / 3;
    }
}

}  // namespace

MeshGeometry measure(Mesh const& mesh)
{
    auto const cells = static_cast<std::size_t>(mesh.cell_count);
    std::vector<CellSums> sums(cells);
    Vector const origin{mesh.points[0], mesh.points[1], mesh.points[2]};
    for (std::size_t face = 0; face < mesh.owner.size(); ++face)
    {
        auto const points = points_of(mesh, face);
        add_face(sums[static_cast<std::size_t>(mesh.owner[face])], points, 1, origin);
        if (face < mesh.neighbour.size())
            add_face(sums[static_cast<std::size_t>(mesh.neighbour[face])], points, -1, origin);
    }

    MeshGeometry geometry;
    for (std::size_t c = 0; c < cells; ++c)
    {
        double const opening = std::sqrt(dot(sums[c].area, sums[c].area)) / std::max(sums[c].magnitude, 1e-300);
        geometry.volumes.push_back(sums[c].volume);
        if (opening > geometry.opening)
        {
            geometry.opening = opening;
            geometry.most_open_cell = static_cast<int>(c);
        }
        if (sums[c].volume < geometry.volumes[static_cast<std::size_t>(geometry.smallest_cell)])
            geometry.smallest_cell = static_cast<int>(c);
    }
    return geometry;
}

std::string find_fault(MeshGeometry const& geometry)
{
    char text[200] = "";
    double const smallest = geometry.volumes[static_cast<std::size_t>(geometry.smallest_cell)];
    if (geometry.opening > largest_opening)
        std::snprintf(text, sizeof text,
                      "cell %d is open: its face areas sum up to %.3g of their magnitudes (0 if "
                      "every normal leaves the owner and no face is missing)",
                      geometry.most_open_cell, geometry.opening);
    else if (!(smallest > 0))
        std::snprintf(text, sizeof text, "cell %d has the volume %.3g m^3 (face normals must leave the owner)",
                      geometry.smallest_cell, smallest);
    return text;
}

}  // namespace gimdem::conformance

// SPDX-License-Identifier: BSD-3-Clause
#include "output/CellTopology.hpp"

#include <algorithm>

namespace gimdem::output
{

namespace
{

using Face = std::vector<std::int32_t>;

bool contains(Face const& face, std::int32_t point)
{
    return std::find(face.begin(), face.end(), point) != face.end();
}

Face sorted(Face face)
{
    std::sort(face.begin(), face.end());
    return face;
}

/// The point that the edge of `cell` leads to from `point` of `bottom` out of it, -1 if there is none.
std::int32_t point_opposite(std::int32_t point, Face const& bottom, CellFaces const& cell)
{
    for (auto const& face : cell)
        for (std::size_t i = 0; i < face.size(); ++i)
        {
            std::int32_t const next = face[(i + 1) % face.size()];
            if (face[i] == point && !contains(bottom, next)) return next;
        }
    return -1;
}

/// The faces of VTK's hexahedron, as places in its list of points.
constexpr std::array<std::array<std::size_t, 4>, 6> hexahedron_faces = {
    {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

bool has_faces(std::array<std::int32_t, 8> const& points, CellFaces const& cell)
{
    return std::all_of(
        hexahedron_faces.begin(), hexahedron_faces.end(),
        [&](auto const& places)
        {
            Face const wanted = sorted({points[places[0]], points[places[1]], points[places[2]], points[places[3]]});
            return std::any_of(cell.begin(), cell.end(), [&](Face const& face) { return sorted(face) == wanted; });
        });
}

/// Visits all cells once, in order, with their faces turned outwards.
class CellWalk
{
public:
    explicit CellWalk(coupling::Mesh const& mesh) : mesh_(mesh), starts_(static_cast<std::size_t>(mesh.cell_count) + 1)
    {
        // count, sum up, fill: faces of cell c are faces_[starts_[c]] ... faces_[starts_[c + 1] - 1]
        for_each_side([&](std::int32_t cell, std::int32_t) { ++starts_[static_cast<std::size_t>(cell) + 1]; });
        for (std::size_t cell = 1; cell < starts_.size(); ++cell)
            starts_[cell] += starts_[cell - 1];
        faces_.resize(starts_.back());
        auto next = starts_;
        for_each_side([&](std::int32_t cell, std::int32_t face)
                      { faces_[next[static_cast<std::size_t>(cell)]++] = face; });
    }

    CellFaces operator()(std::int32_t cell) const
    {
        auto const c = static_cast<std::size_t>(cell);
        CellFaces faces;
        for (std::size_t i = starts_[c]; i < starts_[c + 1]; ++i)
            faces.push_back(outward(static_cast<std::size_t>(faces_[i]), cell));
        return faces;
    }

private:
    template <class Visit>
    void for_each_side(Visit const& visit) const
    {
        for (std::size_t face = 0; face < mesh_.owner.size(); ++face)
        {
            visit(mesh_.owner[face], static_cast<std::int32_t>(face));
            if (face < mesh_.neighbour.size()) visit(mesh_.neighbour[face], static_cast<std::int32_t>(face));
        }
    }

    Face outward(std::size_t face, std::int32_t cell) const
    {
        Face points(mesh_.face_points.begin() + mesh_.face_offsets[face],
                    mesh_.face_points.begin() + mesh_.face_offsets[face + 1]);
        if (mesh_.owner[face] != cell) std::reverse(points.begin(), points.end());
        return points;
    }

    coupling::Mesh const& mesh_;
    std::vector<std::size_t> starts_;  ///< shape=(n_cells + 1,)
    std::vector<std::int32_t> faces_;
};

}  // namespace

std::optional<std::array<std::int32_t, 8>> hexahedron_of(CellFaces const& cell)
{
    bool const six_quads =
        cell.size() == 6 && std::all_of(cell.begin(), cell.end(), [](Face const& face) { return face.size() == 4; });
    if (!six_quads) return std::nullopt;

    // turn the first face into the cell, then climb from each of its points
    auto const& bottom = cell.front();
    std::array<std::int32_t, 8> points{bottom[0], bottom[3], bottom[2], bottom[1], 0, 0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
        points[i + 4] = point_opposite(points[i], bottom, cell);
    return has_faces(points, cell) ? std::optional(points) : std::nullopt;
}

CellTopology::CellTopology(coupling::Mesh const& mesh)
{
    CellWalk const faces_of(mesh);
    for (std::int32_t cell = 0; cell < mesh.cell_count; ++cell)
    {
        CellFaces const cell_faces = faces_of(cell);
        if (auto const points = hexahedron_of(cell_faces))
            add_hexahedron(*points);
        else
            add_polyhedron(cell_faces);
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
}

void CellTopology::add_hexahedron(std::array<std::int32_t, 8> const& points)
{
    connectivity.insert(connectivity.end(), points.begin(), points.end());
    types.push_back(hexahedron);
    face_offsets.push_back(-1);
}

void CellTopology::add_polyhedron(CellFaces const& cell)
{
    faces.push_back(static_cast<std::int64_t>(cell.size()));
    Face points;
    for (auto const& face : cell)
    {
        faces.push_back(static_cast<std::int64_t>(face.size()));
        faces.insert(faces.end(), face.begin(), face.end());
        points.insert(points.end(), face.begin(), face.end());
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());

    connectivity.insert(connectivity.end(), points.begin(), points.end());
    types.push_back(polyhedron);
    face_offsets.push_back(static_cast<std::int64_t>(faces.size()));
}

}  // namespace gimdem::output

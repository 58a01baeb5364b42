// SPDX-License-Identifier: BSD-3-Clause
/// Small meshes whose volumes are known.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::test
{

/// A block of nx ny nz unit cubes, x running fastest.
class Block
{
public:
    Block(int nx, int ny, int nz) : n_{nx, ny, nz}
    {
        for (int k = 0; k <= nz; ++k)
            for (int j = 0; j <= ny; ++j)
                for (int i = 0; i <= nx; ++i)
                    mesh_.points.insert(mesh_.points.end(), {double(i), double(j), double(k)});
        mesh_.cell_count = nx * ny * nz;
        mesh_.face_offsets.push_back(0);
        for (bool const internal : {true, false})
            for (int k = 0; k < nz; ++k)
                for (int j = 0; j < ny; ++j)
                    for (int i = 0; i < nx; ++i)
                        for (std::size_t axis = 0; axis < 3; ++axis)
                            add_faces({i, j, k}, axis, internal);
    }

    coupling::Mesh const& mesh() const { return mesh_; }

private:
    using Place = std::array<int, 3>;

    int point(Place p) const { return p[0] + (n_[0] + 1) * (p[1] + (n_[1] + 1) * p[2]); }
    int cell(Place p) const { return p[0] + n_[0] * (p[1] + n_[1] * p[2]); }

    /// The faces of a cell across an axis: the upper one, and the lower one where the block ends.
    void add_faces(Place const& place, std::size_t axis, bool internal)
    {
        Place upper = place;
        ++upper[axis];
        bool const is_last = upper[axis] == n_[axis];
        if (internal != is_last) add_face(upper, axis, false, cell(place), is_last ? -1 : cell(upper));
        if (!internal && place[axis] == 0) add_face(place, axis, true, cell(place), -1);
    }

    /// The square from `corner` along the other two axes; its normal points along the axis, or against it.
    void add_face(Place const& corner, std::size_t axis, bool against, int owner, int neighbour)
    {
        auto const step = [](Place place, std::size_t along)
        {
            ++place[along];
            return place;
        };
        std::size_t const first = (axis + (against ? 2 : 1)) % 3;
        std::size_t const second = (axis + (against ? 1 : 2)) % 3;
        for (Place const& place :
             {corner, step(corner, first), step(step(corner, first), second), step(corner, second)})
            mesh_.face_points.push_back(point(place));
        mesh_.face_offsets.push_back(static_cast<std::int32_t>(mesh_.face_points.size()));
        mesh_.owner.push_back(owner);
        if (neighbour >= 0) mesh_.neighbour.push_back(neighbour);
    }

    std::array<int, 3> n_;
    coupling::Mesh mesh_;
};

/// `mesh` with cell c becoming a part of cell `cell_of[c]`; faces between two parts of one cell are gone.
inline coupling::Mesh merged(coupling::Mesh const& mesh, std::vector<std::int32_t> const& cell_of, int cell_count)
{
    coupling::Mesh result;
    result.points = mesh.points;
    result.cell_count = cell_count;
    result.face_offsets.push_back(0);
    for (std::size_t face = 0; face < mesh.owner.size(); ++face)
    {
        bool const is_internal = face < mesh.neighbour.size();
        int const owner = cell_of[static_cast<std::size_t>(mesh.owner[face])];
        int const neighbour = is_internal ? cell_of[static_cast<std::size_t>(mesh.neighbour[face])] : -1;
        if (owner == neighbour) continue;
        result.face_points.insert(result.face_points.end(), mesh.face_points.begin() + mesh.face_offsets[face],
                                  mesh.face_points.begin() + mesh.face_offsets[face + 1]);
        result.face_offsets.push_back(static_cast<std::int32_t>(result.face_points.size()));
        result.owner.push_back(owner);
        if (is_internal) result.neighbour.push_back(neighbour);
    }
    return result;
}

/// Three cubes in a row, of which the first two are one cell: a polyhedron of volume 2 and a cube.
inline coupling::Mesh pair_and_cube()
{
    return merged(Block(3, 1, 1).mesh(), {0, 0, 1}, 2);
}

}  // namespace gimdem::test

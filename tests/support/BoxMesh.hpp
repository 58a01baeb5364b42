// SPDX-License-Identifier: BSD-3-Clause
/// A box of hexahedra in owner/neighbour addressing, for tests.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::test
{

/// Builds the mesh of a box with one corner at the origin; cell (i, j, k) has number i + nx (j + ny k).
class BoxMesh
{
public:
    using Size = std::array<int, 3>;
    using Lengths = std::array<double, 3>;  ///< [m]

    static coupling::Mesh make(Size cells, Lengths lengths)
    {
        BoxMesh box(cells);
        box.add_points(lengths);
        box.add_internal_faces();
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side)
                box.add_patch(axis, side);
        return std::move(box.mesh_);
    }

private:
    explicit BoxMesh(Size cells) : n_(cells)
    {
        mesh_.cell_count = n_[0] * n_[1] * n_[2];
        mesh_.face_offsets.push_back(0);
    }

    int cell(Size at) const { return at[0] + n_[0] * (at[1] + n_[1] * at[2]); }
    int point(Size at) const { return at[0] + (n_[0] + 1) * (at[1] + (n_[1] + 1) * at[2]); }

    void add_points(Lengths lengths)
    {
        for (int k = 0; k <= n_[2]; ++k)
            for (int j = 0; j <= n_[1]; ++j)
                for (int i = 0; i <= n_[0]; ++i)
                    for (int axis = 0; axis < 3; ++axis)
                        mesh_.points.push_back(lengths[axis] * Size{i, j, k}[axis] / n_[axis]);
    }

    /// The face of a cell towards lower (side 0) or higher (side 1) coordinates; its normal leaves the cell.
    void add_face(Size at, int axis, int side)
    {
        int const u = (axis + 1) % 3;
        int const v = (axis + 2) % 3;
        std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        if (side == 0) std::swap(corners[1], corners[3]);
        for (auto const& corner : corners)
        {
            Size p = at;
            p[axis] += side;
            p[u] += corner[0];
            p[v] += corner[1];
            mesh_.face_points.push_back(point(p));
        }
        mesh_.face_offsets.push_back(static_cast<std::int32_t>(mesh_.face_points.size()));
        mesh_.owner.push_back(cell(at));
    }

    template <class Visit>
    void for_each_cell(Visit visit) const
    {
        for (int k = 0; k < n_[2]; ++k)
            for (int j = 0; j < n_[1]; ++j)
                for (int i = 0; i < n_[0]; ++i)
                    visit(Size{i, j, k});
    }

    void add_internal_faces()
    {
        for_each_cell(
            [this](Size at)
            {
                for (int axis = 0; axis < 3; ++axis)
                {
                    if (at[axis] + 1 == n_[axis]) continue;
                    Size beyond = at;
                    ++beyond[axis];
                    add_face(at, axis, 1);
                    mesh_.neighbour.push_back(cell(beyond));
                }
            });
    }

    void add_patch(int axis, int side)
    {
        std::array<char const*, 6> constexpr names{"left", "right", "front", "back", "bottom", "top"};
        auto const start = static_cast<std::int32_t>(mesh_.owner.size());
        for_each_cell(
            [&](Size at)
            {
                if (at[axis] == side * (n_[axis] - 1)) add_face(at, axis, side);
            });
        auto const count = static_cast<std::int32_t>(mesh_.owner.size()) - start;
        auto const kind = axis == 2 ? coupling::PatchKind::open : coupling::PatchKind::wall;
        mesh_.patches.push_back({names[2 * axis + side], kind, start, count});
    }

    Size n_;
    coupling::Mesh mesh_;
};

/// The same mesh by reference, as send_mesh() wants it.
inline coupling::MeshView view_of(coupling::Mesh const& mesh)
{
    return {mesh.points,    mesh.face_offsets, mesh.face_points, mesh.owner,
            mesh.neighbour, mesh.cell_count,   mesh.patches};
}

}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Copies of a mesh that do not touch, as one mesh: for more particles than the mesh holds.
#pragma once

#include <cstdint>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::benchmark
{

/// `count` copies, each `spacing` [m] further along x than the one before. All boundaries are one patch of walls.
inline coupling::Mesh copies_of(coupling::Mesh const& one, int count, double spacing)
{
    coupling::Mesh all;
    all.cell_count = count * one.cell_count;
    all.face_offsets = {0};
    std::size_t const internal = one.neighbour.size(), faces = one.owner.size();
    auto const add_faces = [&](int copy, std::size_t from, std::size_t to)
    {
        auto const first_point = static_cast<std::int32_t>(all.points.size() / 3 / static_cast<std::size_t>(count));
        for (std::size_t f = from; f < to; ++f)
        {
            for (std::int32_t k = one.face_offsets[f]; k < one.face_offsets[f + 1]; ++k)
                all.face_points.push_back(one.face_points[static_cast<std::size_t>(k)] + copy * first_point);
            all.face_offsets.push_back(static_cast<std::int32_t>(all.face_points.size()));
            all.owner.push_back(one.owner[f] + copy * one.cell_count);
            if (f < internal) all.neighbour.push_back(one.neighbour[f] + copy * one.cell_count);
        }
    };
    for (int copy = 0; copy < count; ++copy)
        for (std::size_t k = 0; k < one.points.size(); ++k)
            all.points.push_back(one.points[k] + (k % 3 == 0 ? copy * spacing : 0.0));
    for (int copy = 0; copy < count; ++copy)
        add_faces(copy, 0, internal);
    for (int copy = 0; copy < count; ++copy)
        add_faces(copy, internal, faces);
    auto const first = static_cast<std::int32_t>(all.neighbour.size());
    all.patches = {{"sides", coupling::PatchKind::wall, first, static_cast<std::int32_t>(all.owner.size()) - first}};
    return all;
}

}  // namespace gimdem::benchmark

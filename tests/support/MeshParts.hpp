// SPDX-License-Identifier: BSD-3-Clause
/// A mesh cut into the parts that the ranks of a client would have.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::test
{

/// The parts, and which cell of the whole each of their cells is.
struct MeshParts
{
    std::vector<coupling::Mesh> parts;
    std::vector<std::vector<std::int32_t>> cells;
};

/// Cuts as decomposePar does: cells, faces and points keep their order, processor patches follow the others, both sides
/// list their faces in the order of the whole mesh, and on the neighbour's side a face is turned round.
class MeshCutter
{
public:
    MeshCutter(coupling::Mesh const& whole, std::vector<int> rank_of_cell)
        : whole_(whole), rank_of_(std::move(rank_of_cell)), number_of_(rank_of_.size())
    {
        int const ranks = 1 + *std::max_element(rank_of_.begin(), rank_of_.end());
        cut_.parts.resize(static_cast<std::size_t>(ranks));
        cut_.cells.resize(static_cast<std::size_t>(ranks));
        for (std::size_t cell = 0; cell < rank_of_.size(); ++cell)
        {
            auto& cells = cut_.cells[static_cast<std::size_t>(rank_of_[cell])];
            number_of_[cell] = static_cast<std::int32_t>(cells.size());
            cells.push_back(static_cast<std::int32_t>(cell));
        }
        for (int rank = 0; rank < ranks; ++rank)
            cut_.parts[static_cast<std::size_t>(rank)] = part(rank);
    }

    MeshParts result() const { return cut_; }

private:
    int rank_of(std::int32_t cell) const { return rank_of_[static_cast<std::size_t>(cell)]; }

    coupling::Mesh part(int rank)
    {
        mesh_ = {};
        point_.clear();
        mesh_.face_offsets.push_back(0);
        mesh_.cell_count = static_cast<std::int32_t>(cut_.cells[static_cast<std::size_t>(rank)].size());
        std::map<int, std::vector<std::size_t>> shared;
        for (std::size_t f = 0; f < whole_.neighbour.size(); ++f)
        {
            int const a = rank_of(whole_.owner[f]);
            int const b = rank_of(whole_.neighbour[f]);
            if (a == rank && b == rank)
            {
                add_face(f, whole_.owner[f], false);
                mesh_.neighbour.push_back(number_of_[static_cast<std::size_t>(whole_.neighbour[f])]);
            }
            else if (a == rank || b == rank)
                shared[a == rank ? b : a].push_back(f);
        }
        for (coupling::Patch const& patch : whole_.patches)
        {
            auto const start = static_cast<std::int32_t>(mesh_.owner.size());
            for (std::int32_t i = 0; i < patch.face_count; ++i)
            {
                auto const f = static_cast<std::size_t>(patch.start_face + i);
                if (rank_of(whole_.owner[f]) == rank) add_face(f, whole_.owner[f], false);
            }
            add_patch(patch.name, patch.kind, start, 0);
        }
        for (auto const& [other, faces] : shared)
        {
            auto const start = static_cast<std::int32_t>(mesh_.owner.size());
            for (std::size_t const f : faces)
            {
                bool const is_owner = rank_of(whole_.owner[f]) == rank;
                add_face(f, is_owner ? whole_.owner[f] : whole_.neighbour[f], !is_owner);
            }
            add_patch("procBoundary" + std::to_string(rank) + "to" + std::to_string(other),
                      coupling::PatchKind::processor, start, other);
        }
        return mesh_;
    }

    /// Reversed, a face keeps its first point.
    void add_face(std::size_t f, std::int32_t cell, bool reverse)
    {
        std::vector<std::int32_t> points(whole_.face_points.begin() + whole_.face_offsets[f],
                                         whole_.face_points.begin() + whole_.face_offsets[f + 1]);
        if (reverse) std::reverse(points.begin() + 1, points.end());
        for (std::int32_t const point : points)
            mesh_.face_points.push_back(number_of_point(point));
        mesh_.face_offsets.push_back(static_cast<std::int32_t>(mesh_.face_points.size()));
        mesh_.owner.push_back(number_of_[static_cast<std::size_t>(cell)]);
    }

    std::int32_t number_of_point(std::int32_t point)
    {
        auto const [entry, is_new] = point_.emplace(point, static_cast<std::int32_t>(point_.size()));
        auto const x = whole_.points.begin() + 3 * static_cast<std::ptrdiff_t>(point);
        if (is_new) mesh_.points.insert(mesh_.points.end(), x, x + 3);
        return entry->second;
    }

    void add_patch(std::string const& name, coupling::PatchKind kind, std::int32_t start, int other)
    {
        mesh_.patches.push_back({name, kind, start, static_cast<std::int32_t>(mesh_.owner.size()) - start, other});
    }

    coupling::Mesh const& whole_;
    std::vector<int> rank_of_;
    std::vector<std::int32_t> number_of_;  ///< of a cell in its part
    std::map<std::int32_t, std::int32_t> point_;
    coupling::Mesh mesh_;
    MeshParts cut_;
};

inline MeshParts cut(coupling::Mesh const& whole, std::vector<int> const& rank_of_cell)
{
    return MeshCutter(whole, rank_of_cell).result();
}

/// Cells dealt out in runs of the given length: 0 0 0 1 1 1 2 2 2 0 0 0 ...
inline std::vector<int> dealt(std::int32_t cells, int ranks, int run)
{
    std::vector<int> rank_of;
    for (std::int32_t cell = 0; cell < cells; ++cell)
        rank_of.push_back(cell / run % ranks);
    return rank_of;
}

}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
#include "message/MeshMerge.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "message/Message.hpp"
#include "message/ProcessorFaces.hpp"

namespace gimdem::coupling::message
{
namespace
{

/// first[r]: how many there are in the ranks before r. Fault::mesh if the sum does not fit the wire's numbers.
template <class Count>
std::vector<std::size_t> offsets_of(std::vector<Mesh> const& parts, char const* what, Count count)
{
    std::vector<std::size_t> first(1, 0);
    for (Mesh const& part : parts)
        first.push_back(first.back() + count(part));
    if (first.back() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw CouplingError(Fault::mesh, "the ranks have " + std::to_string(first.back()) + " " + what +
                                             " together (at most 2^31 - 1); use a coarser mesh");
    return first;
}

/// Which points of the ranks are one: a forest whose roots are the points with the lowest number.
class PointSets
{
public:
    explicit PointSets(std::size_t count) : parent_(count)
    {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    std::size_t root(std::size_t point)
    {
        while (parent_[point] != point)
            point = parent_[point] = parent_[parent_[point]];
        return point;
    }

    void join(std::size_t a, std::size_t b)
    {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::size_t> parent_;
};

/// A face of the whole mesh, and where its points are listed.
struct WholeFace
{
    std::int32_t owner, neighbour;
    std::size_t rank, face;
};

/// A boundary patch of the whole mesh.
struct WholePatch
{
    Patch patch;
    std::vector<WholeFace> faces;
};

class Merger
{
public:
    explicit Merger(std::vector<Mesh> const& parts)
        : parts_(parts),
          first_cell_(offsets_of(parts, "cells", [](Mesh const& m) { return static_cast<std::size_t>(m.cell_count); })),
          first_point_(offsets_of(parts, "points", [](Mesh const& m) { return m.points.size() / 3; })),
          pairs_(find_face_pairs(parts))
    {
        offsets_of(parts, "faces", [](Mesh const& m) { return m.owner.size(); });
        offsets_of(parts, "points of faces", [](Mesh const& m) { return m.face_points.size(); });
    }

    MergedMesh merge()
    {
        whole_.mesh.cell_count = static_cast<std::int32_t>(first_cell_.back());
        whole_.first_cell.assign(first_cell_.begin(), first_cell_.end());
        whole_.mesh.face_offsets.push_back(0);
        merge_points();
        for (WholeFace const& face : internal_faces())
        {
            add(face);
            whole_.mesh.neighbour.push_back(face.neighbour);
        }
        for (WholePatch& joined : boundary_patches())
        {
            joined.patch.start_face = static_cast<std::int32_t>(whole_.mesh.owner.size());
            joined.patch.face_count = static_cast<std::int32_t>(joined.faces.size());
            for (WholeFace const& face : joined.faces)
                add(face);
            whole_.mesh.patches.push_back(joined.patch);
        }
        return std::move(whole_);
    }

private:
    std::int32_t owner_of(std::size_t rank, std::size_t face) const
    {
        return static_cast<std::int32_t>(first_cell_[rank]) + parts_[rank].owner[face];
    }

    /// Point j of a face, as a number among the points of all ranks.
    std::size_t point_of(std::size_t rank, std::size_t face, std::size_t j) const
    {
        Mesh const& part = parts_[rank];
        auto const at = static_cast<std::size_t>(part.face_offsets[face]) + j;
        return first_point_[rank] + static_cast<std::size_t>(part.face_points[at]);
    }

    std::size_t size_of(std::size_t rank, std::size_t face) const
    {
        auto const& offsets = parts_[rank].face_offsets;
        return static_cast<std::size_t>(offsets[face + 1] - offsets[face]);
    }

    void merge_points()
    {
        PointSets sets(first_point_.back());
        for (FacePair const& pair : pairs_)
        {
            std::size_t const n = size_of(pair.rank_a, pair.face_a);
            for (std::size_t j = 0; j < n; ++j)
                sets.join(point_of(pair.rank_a, pair.face_a, j),
                          point_of(pair.rank_b, pair.face_b, (pair.shift + n - j) % n));
        }
        number_of_point_.resize(first_point_.back());
        for (std::size_t rank = 0; rank < parts_.size(); ++rank)
            for (std::size_t point = first_point_[rank]; point < first_point_[rank + 1]; ++point)
            {
                std::size_t const root = sets.root(point);
                if (root != point)
                {
                    number_of_point_[point] = number_of_point_[root];
                    continue;
                }
                number_of_point_[point] = static_cast<std::int32_t>(whole_.mesh.points.size() / 3);
                double const* const x = &parts_[rank].points[3 * (point - first_point_[rank])];
                whole_.mesh.points.insert(whole_.mesh.points.end(), x, x + 3);
            }
    }

    /// Those of the ranks, and the pairs: a pair's owner is in the lower rank, whose face has the right direction.
    std::vector<WholeFace> internal_faces() const
    {
        std::vector<WholeFace> faces;
        for (std::size_t rank = 0; rank < parts_.size(); ++rank)
            for (std::size_t face = 0; face < parts_[rank].neighbour.size(); ++face)
                faces.push_back({owner_of(rank, face),
                                 static_cast<std::int32_t>(first_cell_[rank]) + parts_[rank].neighbour[face], rank,
                                 face});
        for (FacePair const& pair : pairs_)
            faces.push_back(
                {owner_of(pair.rank_a, pair.face_a), owner_of(pair.rank_b, pair.face_b), pair.rank_a, pair.face_a});
        std::stable_sort(faces.begin(), faces.end(),
                         [](WholeFace const& a, WholeFace const& b)
                         { return std::tie(a.owner, a.neighbour) < std::tie(b.owner, b.neighbour); });
        return faces;
    }

    /// In the order in which the ranks name them.
    std::vector<WholePatch> boundary_patches() const
    {
        std::vector<WholePatch> patches;
        std::map<std::string, std::size_t> position;
        for (std::size_t rank = 0; rank < parts_.size(); ++rank)
            for (Patch const& patch : parts_[rank].patches)
            {
                if (patch.kind == PatchKind::processor) continue;
                auto const [entry, is_new] = position.emplace(patch.name, patches.size());
                if (is_new) patches.push_back({patch, {}});
                WholePatch& whole = patches[entry->second];
                if (whole.patch.kind != patch.kind)
                    throw CouplingError(Fault::mesh, "patch \"" + patch.name + "\" of rank " + std::to_string(rank) +
                                                         " is of another kind than on the ranks before it; decompose "
                                                         "the mesh again");
                for (std::int32_t i = 0; i < patch.face_count; ++i)
                {
                    auto const face = static_cast<std::size_t>(patch.start_face + i);
                    whole.faces.push_back({owner_of(rank, face), -1, rank, face});
                }
            }
        return patches;
    }

    void add(WholeFace const& face)
    {
        for (std::size_t j = 0; j < size_of(face.rank, face.face); ++j)
            whole_.mesh.face_points.push_back(number_of_point_[point_of(face.rank, face.face, j)]);
        whole_.mesh.face_offsets.push_back(static_cast<std::int32_t>(whole_.mesh.face_points.size()));
        whole_.mesh.owner.push_back(face.owner);
    }

    std::vector<Mesh> const& parts_;
    std::vector<std::size_t> first_cell_, first_point_;
    std::vector<FacePair> pairs_;
    std::vector<std::int32_t> number_of_point_;  ///< of a point of all ranks, in the whole mesh
    MergedMesh whole_;
};

}  // namespace

MergedMesh merge_meshes(std::vector<Mesh> const& parts)
{
    return Merger(parts).merge();
}

}  // namespace gimdem::coupling::message

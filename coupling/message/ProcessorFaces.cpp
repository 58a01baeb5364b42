// SPDX-License-Identifier: BSD-3-Clause
#include "message/ProcessorFaces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "message/Message.hpp"

namespace gimdem::coupling::message
{
namespace
{

/// Two ranks read the same point from their own files; what differs by more than this share of the face is another.
double constexpr point_tolerance = 1e-6;

std::string name_of(std::size_t rank, Patch const& patch)
{
    return "patch \"" + patch.name + "\" of rank " + std::to_string(rank);
}

[[noreturn]] void refuse_mesh(std::string const& problem)
{
    throw CouplingError(Fault::mesh, problem + "; decompose the mesh again");
}

/// The processor patch of `rank` to `other`; null if there is none.
Patch const* patch_to(std::vector<Mesh> const& parts, std::size_t rank, std::size_t other)
{
    for (Patch const& patch : parts[rank].patches)
        if (patch.kind == PatchKind::processor && patch.neighbour_rank == static_cast<std::int32_t>(other))
            return &patch;
    return nullptr;
}

void check_patches(std::vector<Mesh> const& parts, std::size_t rank)
{
    std::set<std::int32_t> others;
    for (Patch const& patch : parts[rank].patches)
    {
        if (patch.kind != PatchKind::processor) continue;
        std::int32_t const other = patch.neighbour_rank;
        if (other < 0 || static_cast<std::size_t>(other) >= parts.size() || static_cast<std::size_t>(other) == rank)
            refuse_mesh(name_of(rank, patch) + " leads to rank " + std::to_string(other) + " (there are " +
                        std::to_string(parts.size()) + " ranks, from 0 on, and it must be another one)");
        if (!others.insert(other).second)
            refuse_mesh(name_of(rank, patch) + " leads to rank " + std::to_string(other) +
                        " like another one before it (there is one patch at most between two ranks; periodic "
                        "boundaries must not be cut)");
        Patch const* const partner = patch_to(parts, static_cast<std::size_t>(other), rank);
        std::int32_t const count = partner ? partner->face_count : 0;
        if (count != patch.face_count)
            refuse_mesh(name_of(rank, patch) + " has " + std::to_string(patch.face_count) + " faces, but rank " +
                        std::to_string(other) + " has " + std::to_string(count) + " towards it");
    }
}

/// One face of one rank.
struct Face
{
    Face(Mesh const& of, std::size_t number)
        : mesh(of),
          first(static_cast<std::size_t>(of.face_offsets[number])),
          size(static_cast<std::size_t>(of.face_offsets[number + 1]) - first)
    {
    }

    double const* point(std::size_t j) const
    {
        return &mesh.points[3 * static_cast<std::size_t>(mesh.face_points[first + j])];
    }

    Mesh const& mesh;
    std::size_t first, size;
};

/// The longest side of the box round a face [m].
double extent(Face const& face)
{
    double longest = 0;
    for (std::size_t d = 0; d < 3; ++d)
    {
        double low = face.point(0)[d];
        double high = low;
        for (std::size_t j = 1; j < face.size; ++j)
        {
            low = std::min(low, face.point(j)[d]);
            high = std::max(high, face.point(j)[d]);
        }
        longest = std::max(longest, high - low);
    }
    return longest;
}

/// The shift of FacePair, if there is one.
std::optional<std::size_t> find_shift(Face const& a, Face const& b)
{
    if (a.size != b.size) return std::nullopt;
    double const tolerance = point_tolerance * extent(a);
    auto const same = [&](double const* x, double const* y)
    {
        return std::abs(x[0] - y[0]) <= tolerance && std::abs(x[1] - y[1]) <= tolerance &&
               std::abs(x[2] - y[2]) <= tolerance;
    };
    for (std::size_t shift = 0; shift < a.size; ++shift)
    {
        std::size_t j = 0;
        while (j < a.size && same(a.point(j), b.point((shift + a.size - j) % a.size)))
            ++j;
        if (j == a.size) return shift;
    }
    return std::nullopt;
}

void add_pairs(std::vector<Mesh> const& parts, std::size_t rank, Patch const& patch, std::vector<FacePair>& pairs)
{
    auto const other = static_cast<std::size_t>(patch.neighbour_rank);
    Patch const& partner = *patch_to(parts, other, rank);
    for (std::int32_t i = 0; i < patch.face_count; ++i)
    {
        auto const face_a = static_cast<std::size_t>(patch.start_face + i);
        auto const face_b = static_cast<std::size_t>(partner.start_face + i);
        auto const shift = find_shift(Face(parts[rank], face_a), Face(parts[other], face_b));
        if (!shift)
            refuse_mesh("face " + std::to_string(i) + " of " + name_of(rank, patch) + " is not face " +
                        std::to_string(i) + " of " + name_of(other, partner) +
                        " turned round (both sides must list the same faces in the same order)");
        pairs.push_back({rank, other, face_a, face_b, *shift});
    }
}

}  // namespace

std::vector<FacePair> find_face_pairs(std::vector<Mesh> const& parts)
{
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
        check_patches(parts, rank);
    std::vector<FacePair> pairs;
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
        for (Patch const& patch : parts[rank].patches)
            if (patch.kind == PatchKind::processor && static_cast<std::size_t>(patch.neighbour_rank) > rank)
                add_pairs(parts, rank, patch, pairs);
    return pairs;
}

}  // namespace gimdem::coupling::message

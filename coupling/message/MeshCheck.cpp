// SPDX-License-Identifier: BSD-3-Clause
#include "message/MeshCheck.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "message/Finite.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{
namespace
{

using Problem = std::optional<std::string>;
using Numbers = Span<std::int32_t const>;

std::string text(std::size_t number)
{
    return std::to_string(number);
}

Problem find_count_fault(MeshView const& mesh)
{
    std::size_t constexpr most = std::numeric_limits<std::int32_t>::max();
    if (mesh.cell_count < 1) return "the mesh has " + std::to_string(mesh.cell_count) + " cells (at least 1)";
    if (mesh.points.size() % 3 != 0) return "points has " + text(mesh.points.size()) + " numbers (3 for each point)";
    if (mesh.points.size() / 3 > most || mesh.owner.size() > most) return "the mesh has more than 2^31 points or faces";
    if (mesh.face_offsets.size() != mesh.owner.size() + 1)
        return "face_offsets has " + text(mesh.face_offsets.size()) + " numbers (one more than the " +
               text(mesh.owner.size()) + " faces that owner has)";
    // Four faces a cell, two cells a face; a larger count would only make us allocate in vain.
    if (static_cast<std::size_t>(mesh.cell_count) > mesh.owner.size() / 2)
        return "the mesh has " + std::to_string(mesh.cell_count) + " cells, but only " + text(mesh.owner.size()) +
               " faces (2 or more for each cell)";
    if (mesh.neighbour.size() > mesh.owner.size())
        return "neighbour has " + text(mesh.neighbour.size()) + " numbers (at most the " + text(mesh.owner.size()) +
               " faces)";
    return std::nullopt;
}

Problem find_point_fault(MeshView const& mesh)
{
    if (auto const i = first_not_finite(mesh.points))
        return "point " + text(*i / 3) + " is not finite (" + number_text(mesh.points[*i]) + ")";
    return std::nullopt;
}

Problem find_offset_fault(MeshView const& mesh)
{
    Numbers const offsets = mesh.face_offsets;
    if (offsets[0] != 0) return "face_offsets begins with " + std::to_string(offsets[0]) + " (it must be 0)";
    for (std::size_t face = 0; face + 1 < offsets.size(); ++face)
        if (offsets[face + 1] < std::int64_t{offsets[face]} + 3)
            return "face " + text(face) + " has the offsets " + std::to_string(offsets[face]) + " to " +
                   std::to_string(offsets[face + 1]) + " (a face has 3 points or more)";
    if (static_cast<std::size_t>(offsets[offsets.size() - 1]) != mesh.face_points.size())
        return "face_offsets ends with " + std::to_string(offsets[offsets.size() - 1]) + " (face_points has " +
               text(mesh.face_points.size()) + " numbers)";
    return std::nullopt;
}

Problem find_range_fault(Numbers numbers, std::size_t count, char const* array, char const* what)
{
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] < 0 || static_cast<std::size_t>(numbers[i]) >= count)
            return std::string(array) + "[" + text(i) + "] names " + what + " " + std::to_string(numbers[i]) +
                   " (the mesh has " + text(count) + ")";
    return std::nullopt;
}

/// A cell is closed by four faces at least, and a face does not have the same cell on both sides.
Problem find_cell_fault(MeshView const& mesh)
{
    std::vector<std::int32_t> faces_of(static_cast<std::size_t>(mesh.cell_count), 0);
    for (std::size_t face = 0; face < mesh.owner.size(); ++face)
    {
        ++faces_of[static_cast<std::size_t>(mesh.owner[face])];
        if (face >= mesh.neighbour.size()) continue;
        ++faces_of[static_cast<std::size_t>(mesh.neighbour[face])];
        if (mesh.owner[face] == mesh.neighbour[face])
            return "face " + text(face) + " has cell " + std::to_string(mesh.owner[face]) + " on both sides";
    }
    for (std::size_t cell = 0; cell < faces_of.size(); ++cell)
        if (faces_of[cell] < 4)
            return "cell " + text(cell) + " has " + std::to_string(faces_of[cell]) +
                   " faces (a closed cell has 4 or more)";
    return std::nullopt;
}

Problem find_patch_fault(MeshView const& mesh)
{
    std::set<std::string> names;
    auto next = static_cast<std::int64_t>(mesh.neighbour.size());
    for (Patch const& patch : mesh.patches)
    {
        std::string const who = "patch \"" + patch.name.substr(0, max_name_bytes) + "\"";
        if (patch.name.empty() || patch.name.size() > max_name_bytes) return who + " has an empty or too long name";
        if (!names.insert(patch.name).second) return who + " comes twice";
        if (patch.face_count < 0) return who + " has " + std::to_string(patch.face_count) + " faces";
        if (patch.start_face != next)
            return who + " starts at face " + std::to_string(patch.start_face) + " instead of " + std::to_string(next) +
                   " (patches follow the internal faces and each other without a gap)";
        next += patch.face_count;
    }
    if (next != static_cast<std::int64_t>(mesh.owner.size()))
        return "the patches end at face " + std::to_string(next) + " (the mesh has " + text(mesh.owner.size()) +
               " faces, and each boundary face belongs to a patch)";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> find_mesh_fault(MeshView const& mesh)
{
    auto const cells = static_cast<std::size_t>(mesh.cell_count);
    if (auto fault = find_count_fault(mesh)) return fault;
    if (auto fault = find_point_fault(mesh)) return fault;
    if (auto fault = find_offset_fault(mesh)) return fault;
    if (auto fault = find_range_fault(mesh.face_points, mesh.points.size() / 3, "face_points", "point")) return fault;
    if (auto fault = find_range_fault(mesh.owner, cells, "owner", "cell")) return fault;
    if (auto fault = find_range_fault(mesh.neighbour, cells, "neighbour", "cell")) return fault;
    if (auto fault = find_cell_fault(mesh)) return fault;
    return find_patch_fault(mesh);
}

}  // namespace gimdem::coupling::message

// SPDX-License-Identifier: BSD-3-Clause
#include "message/MeshMessage.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "message/Arrays.hpp"
#include "message/MeshCheck.hpp"

namespace gimdem::coupling::message
{
namespace
{

std::array<std::pair<PatchKind, v1::PatchKind>, 6> constexpr patch_kinds{
    {{PatchKind::wall, v1::PATCH_KIND_WALL},
     {PatchKind::open, v1::PATCH_KIND_OPEN},
     {PatchKind::symmetry, v1::PATCH_KIND_SYMMETRY},
     {PatchKind::empty, v1::PATCH_KIND_EMPTY},
     {PatchKind::cyclic, v1::PATCH_KIND_CYCLIC},
     {PatchKind::processor, v1::PATCH_KIND_PROCESSOR}}};

v1::PatchKind to_wire(PatchKind kind)
{
    for (auto const& [ours, wire] : patch_kinds)
        if (ours == kind) return wire;
    throw CouplingError(Fault::user, "a patch has an unknown kind; use one of enum PatchKind");
}

PatchKind from_wire(v1::Patch const& patch)
{
    for (auto const& [ours, wire] : patch_kinds)
        if (wire == patch.kind()) return ours;
    refuse("Mesh: patch \"" + patch.name().substr(0, max_name_bytes) + "\" has an unknown kind " +
           std::to_string(static_cast<int>(patch.kind())));
}

template <class T>
std::vector<T> copy_array(Message const& message, char const* name, unsigned components)
{
    Span<T const> const values = view_array<T>(message, name, components);
    return {values.begin(), values.end()};
}

}  // namespace

MeshView view_of(Mesh const& mesh)
{
    return {mesh.points,    mesh.face_offsets, mesh.face_points, mesh.owner,
            mesh.neighbour, mesh.cell_count,   mesh.patches};
}

Message pack(MeshView const& mesh)
{
    if (auto const fault = find_mesh_fault(mesh))
        throw CouplingError(Fault::user, *fault + "; check the mesh that is passed to send_mesh()");
    Message message;
    v1::Mesh& body = *message.envelope.mutable_mesh();
    body.set_cell_count(mesh.cell_count);
    for (Patch const& patch : mesh.patches)
    {
        v1::Patch& entry = *body.add_patches();
        entry.set_name(printable(patch.name));
        entry.set_kind(to_wire(patch.kind));
        entry.set_start_face(patch.start_face);
        entry.set_face_count(patch.face_count);
        if (patch.kind == PatchKind::processor) entry.set_neighbour_rank(patch.neighbour_rank);
    }
    append_array(message, "points", 3, mesh.points);
    append_array(message, "face_offsets", 1, mesh.face_offsets);
    append_array(message, "face_points", 1, mesh.face_points);
    append_array(message, "owner", 1, mesh.owner);
    append_array(message, "neighbour", 1, mesh.neighbour);
    return message;
}

Mesh unpack_mesh(Message const& message)
{
    check_array_count(message, 5);
    v1::Mesh const& body = message.envelope.mesh();
    Mesh mesh;
    mesh.cell_count = body.cell_count();
    for (v1::Patch const& patch : body.patches())
        mesh.patches.push_back(
            {patch.name(), from_wire(patch), patch.start_face(), patch.face_count(), patch.neighbour_rank()});
    mesh.points = copy_array<double>(message, "points", 3);
    mesh.face_offsets = copy_array<std::int32_t>(message, "face_offsets", 1);
    mesh.face_points = copy_array<std::int32_t>(message, "face_points", 1);
    mesh.owner = copy_array<std::int32_t>(message, "owner", 1);
    mesh.neighbour = copy_array<std::int32_t>(message, "neighbour", 1);
    if (auto const fault = find_mesh_fault(view_of(mesh))) refuse("Mesh: " + *fault);
    return mesh;
}

Message pack_mesh_accepted(std::int32_t cell_count)
{
    Message message;
    message.envelope.mutable_mesh_accepted()->set_cell_count(cell_count);
    return message;
}

void check_mesh_accepted(Message const& message, std::int32_t cell_count)
{
    std::int32_t const counted = message.envelope.mesh_accepted().cell_count();
    if (counted != cell_count)
        refuse("MeshAccepted: the server counted " + std::to_string(counted) + " cells instead of " +
               std::to_string(cell_count));
}

}  // namespace gimdem::coupling::message

// SPDX-License-Identifier: BSD-3-Clause
#include "c/Views.hpp"

#include <limits>

#include "c/Structs.hpp"

namespace gimdem::coupling::c
{
namespace
{

template <class T>
Span<T const> array(T const* data, std::size_t size, char const* what)
{
    if (size > 0) require(data, what);
    return {data, size};
}

/// Empty where the caller left the field out.
Span<double const> field(double const* data, std::size_t size)
{
    if (data == nullptr) return {};
    return {data, size};
}

std::optional<Schedule> schedule_of(std::int32_t given)
{
    switch (given)
    {
        case GIMDEM_SCHEDULE_OF_SERVER:
            return std::nullopt;
        case GIMDEM_SCHEDULE_SERIAL:
            return Schedule::serial;
        case GIMDEM_SCHEDULE_OVERLAPPED:
            return Schedule::overlapped;
        case GIMDEM_SCHEDULE_ITERATED:
            return Schedule::iterated;
        default:
            refuse("gimdem_client_options.schedule is " + std::to_string(given) +
                   " (it is one of GIMDEM_SCHEDULE_...); choose one");
    }
}

PatchKind kind_of(gimdem_patch const& patch)
{
    switch (patch.kind)
    {
        case GIMDEM_PATCH_WALL:
            return PatchKind::wall;
        case GIMDEM_PATCH_OPEN:
            return PatchKind::open;
        case GIMDEM_PATCH_SYMMETRY:
            return PatchKind::symmetry;
        case GIMDEM_PATCH_EMPTY:
            return PatchKind::empty;
        case GIMDEM_PATCH_CYCLIC:
            return PatchKind::cyclic;
        case GIMDEM_PATCH_PROCESSOR:
            return PatchKind::processor;
        default:
            refuse("patch \"" + text(patch.name) + "\" has kind " + std::to_string(patch.kind) +
                   " (it is one of GIMDEM_PATCH_...); choose one");
    }
}

std::size_t last_offset(gimdem_mesh const& given)
{
    std::int32_t const last = given.face_offsets[given.face_count];
    if (last < 0) refuse("the last of face_offsets is " + std::to_string(last) + " (it counts face_points)");
    return static_cast<std::size_t>(last);
}

}  // namespace

ClientOptions options_of(gimdem_client_options const& given)
{
    ClientOptions options;
    options.endpoint = text(given.endpoint);
    options.name = text(given.name);
    if (given.timeout != 0) options.timeout = given.timeout;
    if (given.connect_time != 0) options.connect_time = given.connect_time;
    if (given.step_time != 0) options.step_time = given.step_time;
    options.schedule = schedule_of(given.schedule);
    options.shared_memory = given.no_shared_memory == 0;
    options.iterates = given.iterates != 0;
    options.rank = {given.rank, given.rank_count == 0 ? 1 : given.rank_count, given.run};
    options.keys = text(given.keys);
    if (given.resume != nullptr)
    {
        auto const resume = read(given.resume, "gimdem_resume_point");
        options.resume = ResumePoint{resume.session, resume.step, resume.time};
    }
    for (char const* name : array(given.wants, given.want_count, "gimdem_client_options.wants"))
        options.wants.push_back(text(name));
    return options;
}

MeshView view_of(gimdem_mesh const& given)
{
    if (given.face_count > std::numeric_limits<std::int32_t>::max() || given.point_count > given.face_count * 64 + 64)
        refuse("the mesh has " + std::to_string(given.point_count) + " points and " + std::to_string(given.face_count) +
               " faces (these cannot be their counts); see gimdem_mesh");
    MeshView mesh;
    mesh.points = array(given.points, 3 * given.point_count, "gimdem_mesh.points");
    mesh.face_offsets = array(given.face_offsets, given.face_count + 1, "gimdem_mesh.face_offsets");
    mesh.face_points = array(given.face_points, last_offset(given), "gimdem_mesh.face_points");
    mesh.owner = array(given.owner, given.face_count, "gimdem_mesh.owner");
    mesh.neighbour = array(given.neighbour, given.internal_face_count, "gimdem_mesh.neighbour");
    mesh.cell_count = given.cell_count;
    for (gimdem_patch const& patch : array(given.patches, given.patch_count, "gimdem_mesh.patches"))
        mesh.patches.push_back(
            {text(patch.name), kind_of(patch), patch.start_face, patch.face_count, patch.neighbour_rank});
    return mesh;
}

FluidFields fields_of(gimdem_fluid_fields const& given)
{
    FluidFields fields;
    fields.velocity = field(given.velocity, 3 * given.cell_count);
    fields.velocity_gradient = field(given.velocity_gradient, 9 * given.cell_count);
    fields.pressure_gradient = field(given.pressure_gradient, 3 * given.cell_count);
    fields.void_fraction_gradient = field(given.void_fraction_gradient, 3 * given.cell_count);
    fields.pressure = field(given.pressure, given.cell_count);
    return fields;
}

std::vector<Monitor> monitors_of(gimdem_monitor const* given, std::size_t count)
{
    std::vector<Monitor> monitors;
    for (gimdem_monitor const& monitor : array(given, count, "monitors"))
        monitors.push_back({text(monitor.name), monitor.value, text(monitor.unit)});
    return monitors;
}

gimdem_solid_fields plain(SolidFields const& fields, std::size_t cell_count)
{
    gimdem_solid_fields solid{};
    solid.cell_count = cell_count;
    solid.void_fraction = fields.void_fraction.data();
    solid.momentum_source = fields.momentum_source.data();
    solid.drag_coefficient = fields.drag_coefficient.data();
    solid.drag_momentum = fields.drag_momentum.data();
    return solid;
}

}  // namespace gimdem::coupling::c

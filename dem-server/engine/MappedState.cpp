// SPDX-License-Identifier: BSD-3-Clause
#include "engine/MappedState.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>

namespace gimdem
{

bool MappedState::fits(std::int64_t particles, std::int32_t cells) const
{
    auto const n = static_cast<std::size_t>(cells);
    return std::ssize(cell_of) == particles && void_fraction.size() == n && drag_coefficient.size() == n &&
           momentum_source.size() == 3 * n && drag_momentum.size() == 3 * n &&
           std::all_of(cell_of.begin(), cell_of.end(), [=](std::int32_t c) { return 0 <= c && c < cells; });
}

std::string mesh_hash(coupling::Mesh const& mesh)
{
    std::uint64_t hash = 0;
    auto const take = [&](auto const& values)
    { hash = XXH3_64bits_withSeed(values.data(), values.size() * sizeof(values[0]), hash); };
    take(mesh.points);
    take(mesh.face_offsets);
    take(mesh.face_points);
    take(mesh.owner);
    take(mesh.neighbour);
    for (coupling::Patch const& patch : mesh.patches)
        take(fmt::format("{} {} {} {}", patch.name, static_cast<int>(patch.kind), patch.start_face, patch.face_count));
    return fmt::format("{:016x}", hash);
}

void add_mapped(output::SnapshotWriter& writer, MappedState const& mapped)
{
    writer.set("mesh", mapped.mesh);
    writer.add("cell_of", mapped.cell_of);
    writer.add("void_fraction", mapped.void_fraction);
    writer.add("drag_coefficient", mapped.drag_coefficient);
    writer.add("momentum_source", mapped.momentum_source, 3);
    writer.add("drag_momentum", mapped.drag_momentum, 3);
}

MappedState mapped_of(output::SnapshotReader const& reader)
{
    if (!reader.has("mesh")) return {};
    return {.mesh = reader.text("mesh"),
            .cell_of = reader.int32s("cell_of"),
            .void_fraction = reader.doubles("void_fraction"),
            .drag_coefficient = reader.doubles("drag_coefficient"),
            .momentum_source = reader.doubles("momentum_source"),
            .drag_momentum = reader.doubles("drag_momentum")};
}

}  // namespace gimdem

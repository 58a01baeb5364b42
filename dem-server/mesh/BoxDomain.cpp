// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoxDomain.hpp"

#include <algorithm>

namespace gimdem
{

bool is_open(DomainSettings const& domain, std::size_t side)
{
    return std::find(domain.open.begin(), domain.open.end(), side_names[side]) != domain.open.end();
}

namespace
{

/// Along a periodic axis the box is longer by half a period at both ends: there a particle that sticks out of the
/// border touches the walls beyond it.
std::array<Triple, 2> box_with_margins(DomainSettings const& domain)
{
    auto box = domain.box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        if (!domain.periodic[axis]) continue;
        double const margin = (box[1][axis] - box[0][axis]) / 2;
        box[0][axis] -= margin;
        box[1][axis] += margin;
    }
    return box;
}

coupling::PatchKind kind_of(DomainSettings const& domain, std::size_t side)
{
    if (domain.periodic[side / 2]) return coupling::PatchKind::cyclic;
    return is_open(domain, side) ? coupling::PatchKind::open : coupling::PatchKind::wall;
}

}  // namespace

coupling::Mesh box_mesh(DomainSettings const& domain)
{
    // Corner k has its x, y, z at the upper end where bit 0, 1, 2 of k is set. Normals leave the box.
    constexpr std::array<std::array<std::int32_t, 4>, 6> sides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    auto const box = box_with_margins(domain);
    coupling::Mesh mesh;
    mesh.cell_count = 1;
    for (std::size_t corner = 0; corner < 8; ++corner)
        for (std::size_t axis = 0; axis < 3; ++axis)
            mesh.points.push_back(box[corner >> axis & 1][axis]);
    mesh.face_offsets = {0};
    for (std::size_t side = 0; side < 6; ++side)
    {
        mesh.face_points.insert(mesh.face_points.end(), sides[side].begin(), sides[side].end());
        mesh.face_offsets.push_back(static_cast<std::int32_t>(mesh.face_points.size()));
        mesh.owner.push_back(0);
        mesh.patches.push_back({side_names[side], kind_of(domain, side), static_cast<std::int32_t>(side), 1});
    }
    return mesh;
}

}  // namespace gimdem

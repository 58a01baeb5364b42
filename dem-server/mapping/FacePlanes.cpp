// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/FacePlanes.hpp"

#include <algorithm>

namespace gimdem
{

FacePlanes::FacePlanes(PolyMesh const& mesh) : mesh_(mesh)
{
    using exec::Octet;
    auto const internal = [&](std::int32_t f) { return f < mesh.internal_face_count(); };
    offsets_.resize(mesh.cell_count() + 1);
    std::int32_t blocks = 0;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        offsets_[c] = blocks;
        auto const count = static_cast<std::int32_t>(std::ranges::count_if(mesh.faces_of_cell(c), internal));
        blocks += std::max(1, (count + exec::octet - 1) / exec::octet);
    }
    offsets_[mesh.cell_count()] = blocks;

    Octet const none = Octet::Constant(0);
    planes_.resize(blocks);
    planes_.fill({none, none, none, Octet::Constant(1e300)});
    MeshKernelView const view = mesh.view();
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        int count = 0;
        for (std::int32_t const f : mesh.faces_of_cell(c))
        {
            if (!internal(f)) continue;
            Vec3 const normal = view.owner[f] == c ? mesh.face_normal(f) : Vec3(-mesh.face_normal(f));
            PlaneOctet& planes = planes_[offsets_[c] + count / exec::octet];
            int const lane = count++ % exec::octet;
            planes.x[lane] = normal.x();
            planes.y[lane] = normal.y();
            planes.z[lane] = normal.z();
            planes.offset[lane] = -view.distance_outside(f, c, mesh.centroid(c));
        }
    }
}

}  // namespace gimdem

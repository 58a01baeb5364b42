// SPDX-License-Identifier: BSD-3-Clause
#include "engine/CellSizeCheck.hpp"

#include <fmt/format.h>

#include "particles/ParticleState.hpp"

namespace gimdem
{

std::string note_on_small_cells(PolyMesh const& mesh, double largest_radius)
{
    double const particle = sphere_volume(largest_radius);
    std::int32_t smallest = 0, count = 0;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        if (mesh.volume(c) < mesh.volume(smallest)) smallest = c;
        count += mesh.volume(c) < particle;
    }
    if (count == 0) return "";
    Vec3 const x = mesh.centroid(smallest);
    return fmt::format(
        "particles are larger than cells: the largest ({:.4g} m in diameter) has {:.3g} times the volume of the "
        "smallest cell (cell {} near ({:.6g}, {:.6g}, {:.6g}) m) and more than {} of {} cells; void fractions may fall "
        "below [mapping] void_fraction_minimum and are then raised to it and counted; a coarser mesh, or [mapping] "
        "method = \"kernel\" or \"diffusion\" with a larger bandwidth, avoids that",
        2 * largest_radius, particle / mesh.volume(smallest), smallest, x.x(), x.y(), x.z(), count, mesh.cell_count());
}

}  // namespace gimdem

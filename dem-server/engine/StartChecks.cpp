// SPDX-License-Identifier: BSD-3-Clause
#include "engine/StartChecks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/Error.hpp"
#include "particles/SizeDistribution.hpp"
#include "search/NeighborList.hpp"

namespace gimdem
{

double shortest_rayleigh_time(Materials const& materials, ParticleState const& particles)
{
    double shortest = std::numeric_limits<double>::infinity();
    for (std::int64_t p = 0; p < particles.count(); ++p)
        shortest = std::min(shortest, materials.rayleigh_time(particles.material[p], particles.position[p].w));
    return shortest;
}

void check_time_step(Case const& settings, Materials const& materials, ParticleState const& particles)
{
    double rayleigh = shortest_rayleigh_time(materials, particles);
    for (InletSettings const& inlet : settings.inlets)
        rayleigh =
            std::min(rayleigh, materials.rayleigh_time(materials.number_of(inlet.material),
                                                       SizeDistribution(inlet.diameter, inlet.sizes).smallest() / 2));
    double const share = settings.dem.time_step / rayleigh;
    if (share <= rayleigh_share_limit) return;
    throw UserError(fmt::format(
        "[dem] time_step = {:.6g} s is {:.3g} % of the Rayleigh time {:.6g} s (above {:.0f} % the "
        "contacts are not resolved and energy is made); use at most {:.3g} s, or a smaller "
        "young_modulus",
        settings.dem.time_step, 100 * share, rayleigh, 100 * rayleigh_share_limit, rayleigh_share_limit * rayleigh));
}

void check_overlaps(exec::Execution execution, ParticleState const& particles)
{
    ParticleState sorted = particles;
    NeighborList list;
    NeighborSearch(execution, 0).build(sorted, list);
    for (std::int64_t k = 0; k < list.pair_count(); ++k)
    {
        Quad const a = sorted.position[list.first[k]];
        Quad const b = sorted.position[list.second[k]];
        double const overlap = a.w + b.w - (a.xyz() - b.xyz()).norm();
        if (overlap <= 0.01 * 2 * std::min(a.w, b.w)) continue;
        throw UserError(
            fmt::format("particles {} and {} overlap by {:.3g} m at ({:.6g}, {:.6g}, {:.6g}) m from the start "
                        "(they would fly apart); increase [[insertion]] spacing, reduce jitter or correct the "
                        "file",
                        sorted.id[list.first[k]], sorted.id[list.second[k]], overlap, a.x, a.y, a.z));
    }
}

}  // namespace gimdem

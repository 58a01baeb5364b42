// SPDX-License-Identifier: BSD-3-Clause
#include "engine/DomainBounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/Error.hpp"
#include "mesh/BoxDomain.hpp"

namespace gimdem
{

DomainBounds::DomainBounds(DomainSettings const& domain) : box_(domain.box), periodic_(domain.periodic)
{
    for (std::size_t side = 0; side < 6; ++side)
    {
        open_[side] = is_open(domain, side);
        causes_.push_back(std::string(open_[side] ? "through " : through_wall) + side_names[side]);
    }
}

double DomainBounds::beyond(Quad const& x, std::size_t side) const
{
    double const at[3] = {x.x, x.y, x.z};
    std::size_t const axis = side / 2;
    return side % 2 == 0 ? box_[0][axis] - at[axis] : at[axis] - box_[1][axis];
}

std::int32_t DomainBounds::side_left(Quad const& x) const
{
    for (std::size_t side = 0; side < 6; ++side)
        if (!periodic_[side / 2] && beyond(x, side) > (open_[side] ? 0 : x.w)) return static_cast<std::int32_t>(side);
    return -1;
}

void DomainBounds::check_start(ParticleState const& particles) const
{
    for (std::int64_t p = 0; p < particles.count(); ++p)
        for (std::size_t side = 0; side < 6; ++side)
        {
            if (periodic_[side / 2]) continue;
            Quad const x = particles.position[p];
            double const distance = beyond(x, side);
            bool const outside = distance > 0;
            if (!outside && (open_[side] || distance + x.w <= 0.01 * 2 * x.w)) continue;
            std::string const what =
                outside ? fmt::format("is {:.3g} m beyond the side {}", distance, side_names[side])
                        : fmt::format("overlaps the wall {} by {:.3g} m", side_names[side], distance + x.w);
            throw UserError(
                fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m {} of [domain] from the start (it would {}); "
                            "correct [[insertion]] or the box",
                            particles.id[p], x.x, x.y, x.z, what, outside ? "be lost" : "fly off"));
        }
}

std::int64_t DomainBounds::remove_leavers(DemSystem& system) const
{
    ParticleState const& particles = std::as_const(system).particles();
    std::vector<std::int32_t> cause(static_cast<std::size_t>(particles.count()), -1);
    bool any = false;
    for (std::size_t i = 0; i < cause.size(); ++i)
    {
        cause[i] = side_left(particles.position[static_cast<std::int64_t>(i)]);
        any |= cause[i] >= 0;
    }
    return any ? system.remove(cause, causes_) : 0;
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "engine/DomainBounds.hpp"

#include <algorithm>

#include "mesh/BoxDomain.hpp"

namespace gimdem
{

DomainBounds::DomainBounds(DomainSettings const& domain) : box_(domain.box), periodic_(domain.periodic)
{
    for (std::size_t side = 0; side < 6; ++side)
    {
        open_[side] = is_open(domain, side);
        causes_.push_back(std::string(open_[side] ? "through " : "through the wall ") + side_names[side]);
    }
}

std::int32_t DomainBounds::side_left(Quad const& x) const
{
    double const at[3] = {x.x, x.y, x.z};
    for (std::size_t side = 0; side < 6; ++side)
    {
        std::size_t const axis = side / 2;
        if (periodic_[axis]) continue;
        double const beyond = side % 2 == 0 ? box_[0][axis] - at[axis] : at[axis] - box_[1][axis];
        if (beyond > (open_[side] ? 0 : x.w)) return static_cast<std::int32_t>(side);
    }
    return -1;
}

std::int64_t DomainBounds::remove_leavers(DemSystem& system) const
{
    ParticleState const& particles = system.particles();
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

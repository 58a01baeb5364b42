// SPDX-License-Identifier: BSD-3-Clause
#include "search/Domain.hpp"

#include <fmt/format.h>

#include "core/Error.hpp"

namespace gimdem
{

Domain Domain::of(DomainSettings const& settings)
{
    Vec3 low = Vec3::Zero(), period = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (settings.periodic[axis])
        {
            low[static_cast<int>(axis)] = settings.box[0][axis];
            period[static_cast<int>(axis)] = settings.box[1][axis] - settings.box[0][axis];
        }
    return {{low.x(), low.y(), low.z()}, {period.x(), period.y(), period.z()}};
}

PeriodicSpace Domain::space() const
{
    auto const inverse = [](double length) { return length > 0 ? 1 / length : 0; };
    return {period, {inverse(period.x), inverse(period.y), inverse(period.z)}};
}

void Domain::require_room(double reach) const
{
    Vec3 const lengths = period.vec();
    for (int axis = 0; axis < 3; ++axis)
        if (lengths[axis] > 0 && lengths[axis] < 2 * reach)
            throw UserError(
                fmt::format("[domain] box is {:.6g} m long along {}, where it is periodic, but two particles can feel "
                            "each other up to {:.6g} m apart (they would meet through both sides at once); make it at "
                            "least {:.6g} m long, or take smaller particles or a smaller [dem] skin",
                            lengths[axis], "xyz"[axis], reach, 2 * reach));
}

}  // namespace gimdem

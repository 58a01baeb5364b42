// SPDX-License-Identifier: BSD-3-Clause
#include "engine/PrecisionCheck.hpp"

#include <fmt/format.h>

#include "core/Error.hpp"

namespace gimdem
{

void check_precision(Case const& settings, double smallest_radius)
{
    if (settings.dem.precision != "mixed") return;
    if (smallest_radius > 0 && smallest_radius < smallest_radius_in_single)
        throw UserError(fmt::format(
            "precision = \"mixed\" with particles of radius {:.3g} m (single precision has no room for squares of "
            "lengths that belong to radii below {:.3g} m); use precision = \"double\"",
            smallest_radius, smallest_radius_in_single));
}

}  // namespace gimdem

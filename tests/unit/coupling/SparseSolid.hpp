// SPDX-License-Identifier: BSD-3-Clause
/// A solid that is in some cells only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "Pair.hpp"
#include "gimdem/coupling/CellRuns.hpp"

namespace gimdem::test
{

/// SolidArrays(cells, start) in the bed, and outside it what a cell without particles has.
inline SolidArrays solid_in(coupling::CellRuns const& bed, std::size_t cells, double start)
{
    SolidArrays solid(cells, start);
    for (std::size_t c = 0; c < cells; ++c)
        if (!contains(bed, {{static_cast<std::int32_t>(c), 1}}))
        {
            solid.void_fraction[c] = 1;
            solid.drag_coefficient[c] = 0;
            std::fill_n(&solid.drag_momentum[3 * c], 3, 0.0);
        }
    return solid;
}

}  // namespace gimdem::test

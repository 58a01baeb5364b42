// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ReverseSlots.hpp"

#include <vector>

namespace gimdem
{

exec::Buffer<std::int32_t> reverse_slots(CellRows const& rows)
{
    std::int64_t const cells = rows.offsets.size() - 1;
    // The rows turned round, which are as long: entry k in the row of i says that i has the place slot[k] in the row of
    // from[k].
    exec::Buffer<std::int32_t> from(rows.cells.size()), slot(rows.cells.size());
    std::vector<std::int32_t> next(rows.offsets.host().begin(), rows.offsets.host().end() - 1);
    for (std::int64_t j = 0; j < cells; ++j)
        for (std::int32_t k = rows.offsets[j]; k < rows.offsets[j + 1]; ++k)
        {
            std::int32_t const at = next[static_cast<std::size_t>(rows.cells[k])]++;
            from[at] = static_cast<std::int32_t>(j);
            slot[at] = k - rows.offsets[j];
        }

    exec::Buffer<std::int32_t> slots(rows.cells.size()), slot_in(cells);
    for (std::int64_t i = 0; i < cells; ++i)
    {
        for (std::int32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k)
            slot_in[from[k]] = slot[k];
        for (std::int32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k)
            slots[k] = slot_in[rows.cells[k]];
    }
    return slots;
}

}  // namespace gimdem

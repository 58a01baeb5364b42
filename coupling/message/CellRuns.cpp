// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/CellRuns.hpp"

#include <cstring>

namespace gimdem::coupling
{
namespace
{

/// A run costs about as many bytes and instructions as the numbers of so many cells.
std::int32_t constexpr least_gap = 4;

/// The first cell from `c` on whose flag is (not) zero, or the number of cells.
std::size_t next(Span<std::uint8_t const> flags, std::size_t c, bool zero)
{
    while (c < flags.size() && (flags[c] == 0) != zero)
    {
        std::uint64_t eight = 0;
        if (!zero && c + sizeof(eight) <= flags.size())
        {
            std::memcpy(&eight, flags.data() + c, sizeof(eight));
            if (eight == 0)
            {
                c += sizeof(eight);
                continue;
            }
        }
        ++c;
    }
    return c;
}

CellRuns join(CellRuns const& runs, std::int32_t gap)
{
    CellRuns joined;
    for (CellRun const& run : runs)
        if (!joined.empty() && run.first - (joined.back().first + joined.back().count) < gap)
            joined.back().count = run.first + run.count - joined.back().first;
        else
            joined.push_back(run);
    return joined;
}

}  // namespace

std::size_t cell_count(CellRuns const& runs)
{
    std::size_t sum = 0;
    for (CellRun const& run : runs)
        sum += static_cast<std::size_t>(run.count);
    return sum;
}

CellRuns runs_where(Span<std::uint8_t const> flags)
{
    CellRuns runs;
    for (std::size_t c = next(flags, 0, false); c < flags.size();)
    {
        std::size_t const end = next(flags, c, true);
        runs.push_back({static_cast<std::int32_t>(c), static_cast<std::int32_t>(end - c)});
        c = next(flags, end, false);
    }
    std::int32_t gap = least_gap;
    for (runs = join(runs, gap); runs.size() > most_runs_sent; gap *= 2)
        runs = join(runs, gap);
    return runs;
}

bool contains(CellRuns const& whole, CellRuns const& part)
{
    std::size_t k = 0;
    for (CellRun const& run : part)
    {
        while (k < whole.size() && whole[k].first + whole[k].count < run.first + run.count)
            ++k;
        if (k == whole.size() || whole[k].first > run.first) return false;
    }
    return true;
}

}  // namespace gimdem::coupling

// SPDX-License-Identifier: BSD-3-Clause
#include "session/RankCells.hpp"

#include <algorithm>
#include <utility>

namespace gimdem::coupling::session
{

RankCells::RankCells(std::vector<std::int32_t> first_cell, message::FieldChoice<SolidFields> wants)
    : first_cell_(std::move(first_cell)), wants_(std::move(wants))
{
}

std::size_t RankCells::count(std::size_t rank) const
{
    return static_cast<std::size_t>(first_cell_[rank + 1] - first_cell_[rank]);
}

void RankCells::check(SolidFields const& fields) const
{
    if (!first_cell_.empty()) message::check_fields(wants_, fields, static_cast<std::size_t>(first_cell_.back()));
}

SolidFields RankCells::cut(SolidFields const& whole, std::size_t rank) const
{
    SolidFields part;
    if (first_cell_.empty()) return part;
    for (auto const& entry : wants_)
    {
        auto const first = static_cast<std::size_t>(first_cell_[rank]) * entry.components;
        part.*entry.values = {(whole.*entry.values).data() + first, count(rank) * entry.components};
    }
    return part;
}

StepCells RankCells::cut(StepCells const& whole, std::size_t rank) const
{
    StepCells part;
    if (first_cell_.empty()) return part;
    if (whole.solid) part.solid = cut(*whole.solid, rank);
    for (NeededCells const& some : whole.needed)
        part.needed.push_back({some.fields, cut(some.cells, rank)});
    return part;
}

CellRuns RankCells::cut(CellRuns const& whole, std::size_t rank) const
{
    std::int32_t const begin = first_cell_[rank], end = first_cell_[rank + 1];
    CellRuns part;
    for (CellRun const& run : whole)
    {
        std::int32_t const first = std::max(run.first, begin);
        std::int32_t const last = std::min(run.first + run.count, end);
        if (first < last) part.push_back({first - begin, last - first});
    }
    return part;
}

FluidFields RankCells::join(std::vector<FluidFields> const& parts)
{
    FluidFields whole;
    for (auto const& entry : message::fluid_fields)
    {
        if ((parts.front().*entry.values).empty()) continue;
        std::vector<double>& values = fluid_[entry.name];
        values.resize(static_cast<std::size_t>(first_cell_.back()) * entry.components);
        for (std::size_t rank = 0; rank < parts.size(); ++rank)
        {
            Span<double const> const part = parts[rank].*entry.values;
            auto const first = static_cast<std::ptrdiff_t>(first_cell_[rank]) * entry.components;
            std::copy(part.begin(), part.end(), values.begin() + first);
        }
        whole.*entry.values = values;
    }
    return whole;
}

}  // namespace gimdem::coupling::session

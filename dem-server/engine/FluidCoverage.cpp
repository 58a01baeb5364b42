// SPDX-License-Identifier: BSD-3-Clause
#include "engine/FluidCoverage.hpp"

#include <algorithm>
#include <utility>

namespace gimdem
{

namespace
{

/// Of face neighbours around the cells with drag. A particle that crosses an edge of its cell shifts its shares by two.
int constexpr layers_ahead = 2;

coupling::Span<std::uint8_t const> as_span(std::vector<std::uint8_t> const& flags)
{
    return {flags.data(), flags.size()};
}

}  // namespace

FluidCoverage::FluidCoverage(PolyMesh const& mesh)
    : mesh_(mesh), monitored_(static_cast<std::size_t>(mesh.cell_count())), loads_(monitored_), velocity_(monitored_)
{
}

void FluidCoverage::monitor(std::span<std::int32_t const> cells)
{
    for (std::int32_t const c : cells)
        monitored_[static_cast<std::size_t>(c)] = 1;
}

void FluidCoverage::look_ahead(std::span<std::int32_t const> cell_of, std::span<std::uint8_t const> has_drag)
{
    std::fill(loads_.begin(), loads_.end(), std::uint8_t{0});
    for (std::int32_t const c : cell_of)
        loads_[static_cast<std::size_t>(c)] = 1;

    velocity_.assign(has_drag.begin(), has_drag.end());
    std::vector<std::int32_t> edge;
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
        if (velocity_[static_cast<std::size_t>(c)] != 0) edge.push_back(c);
    for (int layer = 0; layer < layers_ahead; ++layer)
        grow(edge);
}

/// Adds the face neighbours of the cells at the edge; they are the new edge.
void FluidCoverage::grow(std::vector<std::int32_t>& edge)
{
    coupling::Mesh const& topology = mesh_.topology();
    std::vector<std::int32_t> next;
    for (std::int32_t const c : edge)
        for (std::int32_t const f : mesh_.faces_of_cell(c))
        {
            auto const face = static_cast<std::size_t>(f);
            if (face >= topology.neighbour.size()) continue;
            std::int32_t const other = topology.owner[face] == c ? topology.neighbour[face] : topology.owner[face];
            if (std::exchange(velocity_[static_cast<std::size_t>(other)], std::uint8_t{1}) == 0) next.push_back(other);
        }
    edge = std::move(next);
}

bool FluidCoverage::has_loads(std::span<std::int32_t const> cells) const
{
    return std::all_of(cells.begin(), cells.end(),
                       [&](std::int32_t c) { return loads_[static_cast<std::size_t>(c)] != 0; });
}

bool FluidCoverage::has_velocity(std::span<std::uint8_t const> has_drag) const
{
    return std::equal(has_drag.begin(), has_drag.end(), velocity_.begin(),
                      [](std::uint8_t drag, std::uint8_t chosen) { return drag == 0 || chosen != 0; });
}

std::vector<coupling::NeededCells> FluidCoverage::needed(bool whole_velocity)
{
    namespace field = coupling::field;
    std::vector<std::uint8_t> gradients(loads_);
    for (std::size_t c = 0; c < gradients.size(); ++c)
        gradients[c] |= monitored_[c];
    std::vector<coupling::NeededCells> needed{
        {{field::velocity_gradient}, runs_where(as_span(loads_))},
        {{field::pressure_gradient, field::void_fraction_gradient}, runs_where(as_span(gradients))},
        {{field::pressure}, runs_where(as_span(monitored_))}};
    if (whole_velocity)
        std::fill(velocity_.begin(), velocity_.end(), std::uint8_t{1});
    else
        needed.push_back({{field::velocity}, runs_where(as_span(velocity_))});
    return needed;
}

}  // namespace gimdem

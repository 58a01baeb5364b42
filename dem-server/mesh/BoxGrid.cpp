// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoxGrid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "exec/Sort.hpp"

namespace gimdem
{

BoxGrid::BoxGrid(exec::Buffer<CellBox> boxes) : boxes_(std::move(boxes))
{
    shape();
    list_members();
    fill_nearest();
}

BoxGridView BoxGrid::view_with(CellBox const* boxes, std::int32_t const* offsets, std::int32_t const* members,
                               std::int32_t const* nearest) const
{
    BoxGridView view = shape_;
    view.boxes = boxes;
    view.offsets = offsets;
    view.members = members;
    view.nearest = nearest;
    return view;
}

void BoxGrid::shape()
{
    constexpr double far = std::numeric_limits<double>::infinity();
    double high[3] = {-far, -far, -far};
    std::fill_n(shape_.low, 3, far);
    for (CellBox const& box : boxes_.host())
        for (int axis = 0; axis < 3; ++axis)
        {
            shape_.low[axis] = std::min(shape_.low[axis], box.low[axis]);
            high[axis] = std::max(high[axis], box.high[axis]);
        }
    double volume = 1;
    for (int axis = 0; axis < 3; ++axis)
        volume *= high[axis] - shape_.low[axis];
    double const edge = std::cbrt(volume / static_cast<double>(boxes_.size()));
    for (int axis = 0; axis < 3; ++axis)
    {
        double const length = high[axis] - shape_.low[axis];
        shape_.count[axis] = static_cast<std::int32_t>(std::clamp(length / edge, 1.0, 512.0));
        shape_.per_edge[axis] = shape_.count[axis] / length;
    }
}

void BoxGrid::list_members()
{
    offsets_.resize(std::int64_t{shape_.count[0]} * shape_.count[1] * shape_.count[2] + 1);
    offsets_.fill(0);
    auto const visit_all = [&](auto const& visit)
    {
        for (std::int64_t c = 0; c < boxes_.size(); ++c)
            visit_bins(boxes_[c], 0, [&](std::int64_t bin) { visit(bin, static_cast<std::int32_t>(c)); });
    };
    visit_all([&](std::int64_t bin, std::int32_t) { ++offsets_[bin]; });
    members_.resize(exec::exclusive_scan(offsets_.host()));
    exec::Buffer<std::int32_t> next = offsets_;
    visit_all([&](std::int64_t bin, std::int32_t cell) { members_[next[bin]++] = cell; });
}

// Empty bins take a neighbour's cell, along each axis in turn.
void BoxGrid::fill_nearest()
{
    std::int64_t const bins = offsets_.size() - 1;
    nearest_.resize(bins);
    for (std::int64_t b = 0; b < bins; ++b)
        nearest_[b] = offsets_[b] < offsets_[b + 1] ? members_[offsets_[b]] : -1;
    std::int64_t stride = 1;
    for (std::int32_t const count : shape_.count)
    {
        for (std::int64_t b = stride; b < bins; ++b)
            if (nearest_[b] < 0) nearest_[b] = nearest_[b - stride];
        for (std::int64_t b = bins; b-- > stride;)
            if (nearest_[b - stride] < 0) nearest_[b - stride] = nearest_[b];
        stride *= count;
    }
}

}  // namespace gimdem

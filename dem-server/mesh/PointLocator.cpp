// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PointLocator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gimdem
{

StartCells::StartCells(PolyMesh const& mesh) : low_(mesh.low())
{
    // About one box per cell, of a cell's mean size.
    Vec3 const size = mesh.high() - mesh.low();
    double const edge = std::cbrt(size.prod() / mesh.cell_count());
    for (int axis = 0; axis < 3; ++axis)
    {
        n_[axis] = std::clamp(static_cast<std::int32_t>(size[axis] / edge), 1, 512);
        box_[axis] = size[axis] / n_[axis];
    }
    auto const boxes =
        static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]);
    cell_.assign(boxes, -1);

    // Boxes take the cell whose centroid they hold; empty boxes then take a neighbour's along each axis in turn.
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        Vec3 const at = (mesh.centroid(c) - low_).cwiseQuotient(box_);
        std::size_t index = 0;
        for (int axis = 2; axis >= 0; --axis)
            index = index * static_cast<std::size_t>(n_[axis]) +
                    static_cast<std::size_t>(std::clamp(static_cast<std::int32_t>(at[axis]), 0, n_[axis] - 1));
        if (cell_[index] < 0) cell_[index] = c;
    }
    for (std::size_t stride : {std::size_t{1}, static_cast<std::size_t>(n_[0]),
                               static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1])})
    {
        for (std::size_t i = stride; i < boxes; ++i)
            if (cell_[i] < 0) cell_[i] = cell_[i - stride];
        for (std::size_t i = boxes; i-- > stride;)
            if (cell_[i - stride] < 0) cell_[i - stride] = cell_[i];
    }
}

std::int32_t StartCells::near(Vec3 const& x) const
{
    Vec3 const at = (x - low_).cwiseQuotient(box_);
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis)
        index =
            index * static_cast<std::size_t>(n_[axis]) +
            static_cast<std::size_t>(at[axis] > 0 ? std::min(static_cast<std::int32_t>(at[axis]), n_[axis] - 1) : 0);
    return std::max(cell_[index], 0);
}

}  // namespace gimdem

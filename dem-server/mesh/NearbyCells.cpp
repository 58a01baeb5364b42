// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NearbyCells.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace gimdem
{

exec::Buffer<CellBox> cell_boxes(PolyMesh const& mesh)
{
    constexpr double far = std::numeric_limits<double>::infinity();
    exec::Buffer<CellBox> boxes(mesh.cell_count());
    boxes.fill({{far, far, far}, {-far, -far, -far}});
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        for (std::int32_t const f : mesh.faces_of_cell(c))
            for (std::int32_t const p : mesh.points_of_face(f))
            {
                Vec3 const x = mesh.point(p);
                for (int axis = 0; axis < 3; ++axis)
                {
                    boxes[c].low[axis] = std::min(boxes[c].low[axis], x[axis]);
                    boxes[c].high[axis] = std::max(boxes[c].high[axis], x[axis]);
                }
            }
    return boxes;
}

CellRows nearby_cells(exec::Buffer<CellBox> const& boxes, double reach)
{
    BoxGrid const grid(boxes);
    std::vector<std::int32_t> all, row;
    std::vector<std::int32_t> seen_by(static_cast<std::size_t>(boxes.size()), -1);
    CellRows rows;
    rows.offsets.resize(boxes.size() + 1);
    for (std::int64_t c = 0; c < boxes.size(); ++c)
    {
        auto const cell = static_cast<std::int32_t>(c);
        rows.offsets[c] = static_cast<std::int32_t>(all.size());
        row.clear();
        seen_by[static_cast<std::size_t>(c)] = cell;
        grid.visit_cells(boxes[c], reach,
                         [&](std::int32_t other)
                         {
                             std::int32_t& seen = seen_by[static_cast<std::size_t>(other)];
                             if (seen == cell) return;
                             seen = cell;
                             if (boxes[c].distance2(boxes[other]) <= reach * reach) row.push_back(other);
                         });
        std::ranges::sort(row);
        all.push_back(cell);
        all.insert(all.end(), row.begin(), row.end());
    }
    rows.offsets[boxes.size()] = static_cast<std::int32_t>(all.size());
    rows.cells.resize(static_cast<std::int64_t>(all.size()));
    std::ranges::copy(all, rows.cells.host().begin());
    return rows;
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NearbyCells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "exec/Sort.hpp"

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

namespace
{

/// A grid over the mesh; each of its bins knows the boxes that it meets.
class BoxGrid
{
public:
    explicit BoxGrid(exec::Buffer<CellBox> const& boxes)
    {
        constexpr double far = std::numeric_limits<double>::infinity();
        double high[3] = {-far, -far, -far};
        std::fill_n(low_, 3, far);
        for (CellBox const& box : boxes.host())
            for (int axis = 0; axis < 3; ++axis)
            {
                low_[axis] = std::min(low_[axis], box.low[axis]);
                high[axis] = std::max(high[axis], box.high[axis]);
            }
        double const volume = (high[0] - low_[0]) * (high[1] - low_[1]) * (high[2] - low_[2]);
        double const edge = std::cbrt(volume / static_cast<double>(boxes.size()));
        for (int axis = 0; axis < 3; ++axis)
        {
            count_[axis] = std::clamp(static_cast<int>((high[axis] - low_[axis]) / edge), 1, 512);
            edge_[axis] = (high[axis] - low_[axis]) / count_[axis];
        }
        offsets_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2] + 1), 0);
        auto const visit_all = [&](auto const& visit)
        {
            for (std::int64_t c = 0; c < boxes.size(); ++c)
                visit_bins(boxes[c], 0, [&](std::size_t bin) { visit(bin, static_cast<std::int32_t>(c)); });
        };
        visit_all([&](std::size_t bin, std::int32_t) { ++offsets_[bin]; });
        members_.resize(static_cast<std::size_t>(exec::exclusive_scan(offsets_)));
        std::vector<std::int32_t> next = offsets_;
        visit_all([&](std::size_t bin, std::int32_t cell) { members_[static_cast<std::size_t>(next[bin]++)] = cell; });
    }

    /// Cells of all bins within `reach` of a box; some more than once.
    template <class Visit>
    void visit_cells(CellBox const& box, double reach, Visit visit) const
    {
        visit_bins(box, reach,
                   [&](std::size_t bin)
                   {
                       for (std::int32_t m = offsets_[bin]; m < offsets_[bin + 1]; ++m)
                           visit(members_[static_cast<std::size_t>(m)]);
                   });
    }

private:
    int bin_of(double x, int axis) const
    {
        double const at = (x - low_[axis]) / edge_[axis];
        return at > 0 ? std::min(static_cast<int>(std::min(at, 512.0)), count_[axis] - 1) : 0;
    }

    template <class Visit>
    void visit_bins(CellBox const& box, double reach, Visit visit) const
    {
        int first[3], last[3];
        for (int axis = 0; axis < 3; ++axis)
        {
            first[axis] = bin_of(box.low[axis] - reach, axis);
            last[axis] = bin_of(box.high[axis] + reach, axis);
        }
        for (int k = first[2]; k <= last[2]; ++k)
            for (int j = first[1]; j <= last[1]; ++j)
                for (int i = first[0]; i <= last[0]; ++i)
                    visit(static_cast<std::size_t>(i + count_[0] * (j + count_[1] * k)));
    }

    double low_[3], edge_[3];
    int count_[3];
    std::vector<std::int32_t> offsets_, members_;
};

}  // namespace

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

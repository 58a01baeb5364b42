// SPDX-License-Identifier: BSD-3-Clause
/// A grid over the mesh whose bins know the cells that reach into them: which cells a point may be in, and which cells
/// are near a box.
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "exec/Vector.hpp"
#include "mesh/CellBox.hpp"

namespace gimdem
{

/// What kernels see of a BoxGrid.
struct BoxGridView
{
    double low[3], per_edge[3];  ///< corner [m], bins per length [1/m]
    std::int32_t count[3];       ///< bins along each axis
    CellBox const* boxes;
    std::int32_t const* offsets;  ///< cells whose boxes meet bin b are members[offsets[b] ... offsets[b + 1]), rising
    std::int32_t const* members;
    std::int32_t const* nearest;  ///< a cell of each bin or, where it has none, of one close to it

    GIMDEM_HD std::int32_t along(double x, int axis) const
    {
        double const at = (x - low[axis]) * per_edge[axis];
        std::int32_t const last = count[axis] - 1;
        return at > 0 ? (at < last ? static_cast<std::int32_t>(at) : last) : 0;
    }
    GIMDEM_HD std::int64_t bin(Vec3 const& x) const
    {
        return along(x[0], 0) + count[0] * (along(x[1], 1) + std::int64_t{count[1]} * along(x[2], 2));
    }
    /// A cell to begin a search at.
    GIMDEM_HD std::int32_t near(Vec3 const& x) const { return nearest[bin(x)]; }
};

class BoxGrid
{
public:
    /// About one bin for each cell.
    explicit BoxGrid(exec::Buffer<CellBox> boxes);

    exec::Buffer<CellBox> const& boxes() const { return boxes_; }
    exec::Buffer<std::int32_t> const& offsets() const { return offsets_; }
    exec::Buffer<std::int32_t> const& members() const { return members_; }
    exec::Buffer<std::int32_t> const& nearest() const { return nearest_; }

    BoxGridView view() const
    {
        return view_with(boxes_.view().data, offsets_.view().data, members_.view().data, nearest_.view().data);
    }
    /// With the arrays elsewhere: in the memory of a device.
    BoxGridView view_with(CellBox const* boxes, std::int32_t const* offsets, std::int32_t const* members,
                          std::int32_t const* nearest) const;

    /// Cells of all bins within `reach` [m] of a box; some more than once.
    template <class Visit>
    void visit_cells(CellBox const& box, double reach, Visit visit) const
    {
        visit_bins(box, reach,
                   [&](std::int64_t bin)
                   {
                       for (std::int32_t m = offsets_[bin]; m < offsets_[bin + 1]; ++m)
                           visit(members_[m]);
                   });
    }

private:
    void shape();
    void list_members();
    void fill_nearest();

    template <class Visit>
    void visit_bins(CellBox const& box, double reach, Visit visit) const
    {
        std::int32_t first[3], last[3];
        for (int axis = 0; axis < 3; ++axis)
        {
            first[axis] = shape_.along(box.low[axis] - reach, axis);
            last[axis] = shape_.along(box.high[axis] + reach, axis);
        }
        for (std::int32_t k = first[2]; k <= last[2]; ++k)
            for (std::int32_t j = first[1]; j <= last[1]; ++j)
                for (std::int32_t i = first[0]; i <= last[0]; ++i)
                    visit(i + shape_.count[0] * (j + std::int64_t{shape_.count[1]} * k));
    }

    BoxGridView shape_{};
    exec::Buffer<CellBox> boxes_;
    exec::Buffer<std::int32_t> offsets_, members_, nearest_;
};

}  // namespace gimdem

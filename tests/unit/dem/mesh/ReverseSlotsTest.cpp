// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ReverseSlots.hpp"

#include <gtest/gtest.h>

#include "BoxMesh.hpp"
#include "mesh/NearbyCells.hpp"

namespace
{

using gimdem::CellLayers;
using gimdem::CellRows;
using gimdem::PolyMesh;
using gimdem::test::BoxMesh;

/// The definition: entry `slot` of the row of cells[k] is the row's own cell.
void expect_reverse(CellRows const& rows)
{
    auto const slots = gimdem::reverse_slots(rows);
    ASSERT_EQ(slots.size(), rows.cells.size());
    for (std::int64_t i = 0; i + 1 < rows.offsets.size(); ++i)
        for (std::int32_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k)
        {
            std::int32_t const j = rows.cells[k];
            ASSERT_GE(slots[k], 0);
            ASSERT_LT(slots[k], rows.offsets[j + 1] - rows.offsets[j]);
            EXPECT_EQ(rows.cells[rows.offsets[j] + slots[k]], i) << "from " << j;
        }
}

// Rows of layers are in no order of numbers, those of nearby cells rise behind the first.
TEST(ReverseSlots, LeadBackFromEveryRow)
{
    PolyMesh const mesh(BoxMesh::make({5, 4, 3}, {1, 1, 1}));

    expect_reverse(CellLayers(mesh));
    expect_reverse(gimdem::nearby_cells(gimdem::cell_boxes(mesh), 0.3));
}

TEST(ReverseSlots, OfACellAloneIsZero)
{
    auto const rows = gimdem::nearby_cells(gimdem::cell_boxes(PolyMesh(BoxMesh::make({1, 1, 1}, {1, 1, 1}))), 1);

    expect_reverse(rows);
    EXPECT_EQ(gimdem::reverse_slots(rows)[0], 0);
}

}  // namespace

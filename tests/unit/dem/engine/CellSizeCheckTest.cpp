// SPDX-License-Identifier: BSD-3-Clause
#include "engine/CellSizeCheck.hpp"

#include <gtest/gtest.h>

#include "BoxMesh.hpp"

namespace
{

using namespace gimdem;

// A ball of diameter 1 has pi/6 = 0.5236: 1.047 times a cell of 0.5.
TEST(CellSizeCheck, TellsTheRatioTheCellAndTheirNumber)
{
    PolyMesh const mesh(test::BoxMesh::make({4, 2, 1}, {4, 1, 1}));
    EXPECT_EQ(note_on_small_cells(mesh, 0.49), "");
    std::string const note = note_on_small_cells(mesh, 0.5);
    EXPECT_NE(note.find("1.05 times the volume"), std::string::npos) << note;
    EXPECT_NE(note.find("cell 0 near (0.5, 0.25, 0.5) m"), std::string::npos) << note;
    EXPECT_NE(note.find("more than 8 of 8 cells"), std::string::npos) << note;
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "engine/AddedMassCheck.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace
{

using namespace gimdem;

// (1 - 0.4)/0.4 = 1.5 times the water's density.
TEST(AddedMassCheck, WarnsWhereTheLiquidAnswersWithMoreThanTheParticlesHave)
{
    std::vector<double> const bed{1, 0.4, 0.7};
    EXPECT_EQ(note_on_added_mass(1000, 1501, bed), "");
    std::string const note = note_on_added_mass(1000, 1499, bed);
    EXPECT_NE(note.find("void fraction is 0.4,"), std::string::npos) << note;
    EXPECT_NE(note.find("like 1500 kg/m^3, and they have 1499 kg/m^3"), std::string::npos) << note;
    EXPECT_NE(note.find("schedule = \"iterated\""), std::string::npos) << note;
}

TEST(AddedMassCheck, SaysNothingOfGasesAndEmptyMeshes)
{
    EXPECT_EQ(note_on_added_mass(1.2, 20, std::vector<double>{0.36}), "");
    EXPECT_EQ(note_on_added_mass(1000, 100, std::vector<double>{1, 1}), "");
    EXPECT_EQ(note_on_added_mass(1000, 100, {}), "");
}

}  // namespace

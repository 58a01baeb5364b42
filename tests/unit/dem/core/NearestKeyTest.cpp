// SPDX-License-Identifier: BSD-3-Clause
#include "core/NearestKey.hpp"

#include <gtest/gtest.h>

namespace
{

using namespace gimdem;

TEST(EditDistance, CountsEachKindOfSlipOnce)
{
    EXPECT_EQ(edit_distance("friction", "friction"), 0u);
    EXPECT_EQ(edit_distance("friction", "frction"), 1u);
    EXPECT_EQ(edit_distance("friction", "frictions"), 1u);
    EXPECT_EQ(edit_distance("friction", "fraction"), 1u);
    EXPECT_EQ(edit_distance("friction", "firction"), 1u);
}

TEST(EditDistance, IsSymmetricAndMeasuresAgainstNothing)
{
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("sitting", "kitten"), 3u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
}

TEST(NearestKey, TakesTheNearestOfSeveral)
{
    EXPECT_EQ(nearest_key("grods", {"grid", "grids", "until"}), "grids");
}

TEST(NearestKey, FindsNothingWhereAllLettersDiffer)
{
    EXPECT_EQ(nearest_key("wavelength", {"grid", "until"}), "");
    EXPECT_EQ(nearest_key("C", {"A", "B"}), "");
}

TEST(SuggestKey, ListsAllWhereNoneIsNear)
{
    EXPECT_EQ(suggest_key("wavelength", {"grid", "until"}), "known are: grid, until");
    EXPECT_EQ(suggest_key("gird", {"grid", "until"}), "did you mean \"grid\"?");
}

}  // namespace

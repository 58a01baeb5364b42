// SPDX-License-Identifier: BSD-3-Clause
#include "output/Summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "Files.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::output::Summary;

TEST(Summary, PrintsAFigureOnALine)
{
    Summary summary;
    summary.add("settled_height", 0.123456789, "m");
    summary.add("particles_lost", 0, "1");
    std::ostringstream out;

    summary.print(out);

    EXPECT_EQ(out.str(), "figure: settled_height = 0.123457 [m]\nfigure: particles_lost = 0 [1]\n");
}

TEST(Summary, FigureOfTheSameNameIsReplacedInPlace)
{
    Summary summary;
    summary.add("a", 1, "m");
    summary.add("b", 2, "m");
    summary.add("a", 3, "s");

    ASSERT_EQ(summary.figures().size(), 2u);
    EXPECT_EQ(summary.figures()[0].value, 3);
    EXPECT_EQ(summary.figures()[0].unit, "s");
}

TEST(Summary, JsonHoldsAllDigitsAndNullForWhatIsNoNumber)
{
    Folder const folder;
    Summary summary;
    summary.add("third", 1.0 / 3, "m/s^2");
    summary.add("a \"quoted\\ name\n", NAN, "1");

    summary.write(folder / "out/summary.json");

    EXPECT_EQ(read_text(folder / "out/summary.json"),
              "{\"figures\": [\n"
              "  {\"name\": \"third\", \"value\": 0.3333333333333333, \"unit\": \"m/s^2\"},\n"
              "  {\"name\": \"a \\\"quoted\\\\ name\\u000a\", \"value\": null, \"unit\": \"1\"}\n"
              "]}\n");
}

TEST(Summary, WithoutFiguresIsStillJson)
{
    Folder const folder;

    Summary().write(folder / "summary.json");

    EXPECT_EQ(read_text(folder / "summary.json"), "{\"figures\": [\n]}\n");
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "output/TimeSeries.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "Files.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::output::TimeSeries;

TEST(TimeSeries, HeaderNamesColumnsAndUnits)
{
    Folder const folder;

    TimeSeries const series(folder / "sub/bed.csv", {{"time", "s"}, {"bed_height", "m"}, {"a,b", "1"}});

    EXPECT_EQ(read_text(series.file()), "time [s],bed_height [m],\"a,b [1]\"\n");
}

TEST(TimeSeries, NumbersReadBackToTheSameBits)
{
    Folder const folder;
    TimeSeries series(folder / "bed.csv", {{"x", "1"}});
    double const values[] = {0.0,
                             -0.0,
                             0.1,
                             1.0 / 3,
                             1e-300,
                             5e-324,
                             1.7976931348623157e308,
                             -123456789.123456789,
                             std::numeric_limits<double>::infinity()};

    for (double const value : values)
        series.append({&value, 1});

    std::istringstream lines(read_text(series.file()));
    std::string line;
    std::getline(lines, line);
    for (double const value : values)
    {
        ASSERT_TRUE(std::getline(lines, line));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(line.c_str(), nullptr)), std::bit_cast<std::uint64_t>(value))
            << line;
    }
}

TEST(TimeSeries, EachRowIsInTheFileAtOnce)
{
    Folder const folder;
    TimeSeries series(folder / "bed.csv", {{"time", "s"}, {"height", "m"}});

    series.append(std::vector{0.001, 0.25});

    EXPECT_EQ(read_text(series.file()), "time [s],height [m]\n0.001,0.25\n");
}

TEST(TimeSeries, RowOfAnotherLengthIsRefused)
{
    Folder const folder;
    TimeSeries series(folder / "bed.csv", {{"time", "s"}, {"height", "m"}});

    EXPECT_THROW(series.append(std::vector{0.001}), std::invalid_argument);
}

TEST(TimeSeries, FullDiskIsNamed)
{
    Folder const folder;
    TimeSeries series(folder / "bed.csv", {{"time", "s"}});

    std::string const message = message_of(
        [&]
        {
            FullDisk const disk(64);
            for (int i = 0; i < 100; ++i)
                series.append(std::vector{0.123456789});
        });

    EXPECT_EQ(message,
              "cannot write " + series.file().string() + " (File too large); free some space or choose another folder");
}

}  // namespace

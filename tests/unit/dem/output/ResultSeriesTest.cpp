// SPDX-License-Identifier: BSD-3-Clause
#include "output/ResultSeries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Meshes.hpp"
#include "VtkFile.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::output::ParticleFrame;
using gimdem::output::ResultSeries;
using testing::HasSubstr;

/// Number of times that `part` occurs in `text`.
int count(std::string const& text, std::string const& part)
{
    int found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

void write_frames(ResultSeries& series, std::vector<double> const& times)
{
    std::vector<double> const position(3);
    for (double const time : times)
    {
        ParticleFrame frame;
        frame.time = time;
        frame.position = position;
        series.write(time, frame, {});
    }
}

TEST(ResultSeries, IndexListsBothPartsOfEachFrame)
{
    Folder const folder;
    ResultSeries series(folder / "results", Block(1, 1, 1).mesh());

    write_frames(series, {0, 0.01});

    EXPECT_EQ(series.frame_count(), 2);
    EXPECT_EQ(read_text(series.index()),
              "<?xml version=\"1.0\"?>\n"
              "<VTKFile type=\"Collection\" version=\"1.0\">\n"
              "  <Collection>\n"
              "    <DataSet timestep=\"0\" part=\"0\" name=\"cells\" file=\"cells/cells_000000.vtu\"/>\n"
              "    <DataSet timestep=\"0\" part=\"1\" name=\"particles\" file=\"particles/particles_000000.vtp\"/>\n"
              "    <DataSet timestep=\"0.01\" part=\"0\" name=\"cells\" file=\"cells/cells_000001.vtu\"/>\n"
              "    <DataSet timestep=\"0.01\" part=\"1\" name=\"particles\" file=\"particles/particles_000001.vtp\"/>\n"
              "  </Collection>\n"
              "</VTKFile>\n");
}

TEST(ResultSeries, EveryListedFileExistsAndHasTheListedTime)
{
    Folder const folder;
    ResultSeries series(folder.path(), Block(1, 1, 1).mesh());

    write_frames(series, {0, 0.1, 0.30000000000000004});

    EXPECT_THAT(read_text(series.index()), HasSubstr("timestep=\"0.30000000000000004\""));
    EXPECT_EQ(VtkFile(folder / "cells/cells_000002.vtu").array<double>("TimeValue")[0], 0.30000000000000004);
    EXPECT_EQ(VtkFile(folder / "particles/particles_000002.vtp").array<double>("TimeValue")[0], 0.30000000000000004);
}

TEST(ResultSeries, ResumesBeforeTheTimeOfTheRestart)
{
    Folder const folder;
    auto const mesh = Block(1, 1, 1).mesh();
    ResultSeries first(folder.path(), mesh);
    write_frames(first, {0, 0.1, 0.2, 0.3});

    ResultSeries second(folder.path(), mesh);
    int const kept = second.resume(0.2 * (1 + 1e-12));
    write_frames(second, {0.2, 0.25});

    EXPECT_EQ(kept, 2);
    EXPECT_EQ(second.frame_count(), 4);
    std::string const index = read_text(second.index());
    EXPECT_EQ(count(index, "<DataSet "), 8);
    EXPECT_EQ(count(index, "timestep=\"0.3\""), 0);
    EXPECT_EQ(VtkFile(folder / "cells/cells_000003.vtu").array<double>("TimeValue")[0], 0.25);
}

TEST(ResultSeries, ResumesWithNothingWhereThereIsNoSeries)
{
    Folder const folder;
    ResultSeries series(folder.path(), Block(1, 1, 1).mesh());

    EXPECT_EQ(series.resume(1.0), 0);
}

TEST(ResultSeries, FrameThatFailsIsNotListed)
{
    Folder const folder;
    ResultSeries series(folder.path(), Block(1, 1, 1).mesh());
    write_frames(series, {0});
    std::string const before = read_text(series.index());

    std::string const message = message_of(
        [&]
        {
            FullDisk const disk(500);
            write_frames(series, {0.1});
        });

    EXPECT_THAT(message, HasSubstr("cannot write"));
    EXPECT_EQ(series.frame_count(), 1);
    EXPECT_EQ(read_text(series.index()), before);
}

}  // namespace

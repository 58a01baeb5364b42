// SPDX-License-Identifier: BSD-3-Clause
#include "output/VtkCells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Meshes.hpp"
#include "VtkFile.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::output::CellField;
using gimdem::output::VtkCells;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(VtkCells, FieldsReadBackAsWritten)
{
    Folder const folder;
    VtkCells const cells(pair_and_cube());
    std::vector<double> const void_fraction = {0.4, 1.0};
    std::vector<double> const velocity = {1, 2, 3, 4, 5, 6};

    cells.write(folder / "a.vtu", 0.125,
                std::vector<CellField>{{"void_fraction", 1, void_fraction}, {"velocity", 3, velocity}});

    VtkFile const file(folder / "a.vtu");
    EXPECT_THAT(file.head(), HasSubstr("NumberOfPoints=\"16\" NumberOfCells=\"2\""));
    EXPECT_THAT(file.array<float>("void_fraction"), ElementsAre(0.4f, 1.0f));
    EXPECT_THAT(file.array<float>("velocity"), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_EQ(file.attribute("velocity", "NumberOfComponents"), "3");
    EXPECT_EQ(file.attribute("velocity", "type"), "Float32");
    EXPECT_THAT(file.array<double>("TimeValue"), ElementsAre(0.125));
    EXPECT_EQ(file.array<float>("Points").size(), 48u);
    EXPECT_THAT(file.array<std::uint8_t>("types"), ElementsAre(42, 12));
    EXPECT_THAT(file.array<std::int64_t>("offsets"), ElementsAre(12, 20));
    EXPECT_EQ(file.array<std::int64_t>("faceoffsets")[1], -1);
    EXPECT_EQ(file.array<std::int64_t>("faces").size(), 51u);  // 1 + 10 (1 + 4)
}

TEST(VtkCells, BlockNeedsNoFaces)
{
    Folder const folder;
    VtkCells const cells(Block(2, 1, 1).mesh());

    cells.write(folder / "a.vtu", 0, {});

    VtkFile const file(folder / "a.vtu");
    EXPECT_FALSE(file.has("faces"));
    EXPECT_THAT(file.array<std::uint8_t>("types"), ElementsAre(12, 12));
}

TEST(VtkCells, LongArraysAreWrittenInSeveralBlocks)
{
    Folder const folder;
    VtkCells const cells(Block(50, 50, 40).mesh());  // 400 kB of floats, blocks of 256 KiB
    std::vector<double> values(100000);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<double>(i);

    cells.write(folder / "a.vtu", 0, std::vector<CellField>{{"number", 1, values}});

    auto const read = VtkFile(folder / "a.vtu").array<float>("number");
    EXPECT_EQ(read, std::vector<float>(values.begin(), values.end()));
}

TEST(VtkCells, NamesAreEscaped)
{
    Folder const folder;
    VtkCells const cells(Block(1, 1, 1).mesh());
    double const value = 1;

    cells.write(folder / "a.vtu", 0, std::vector<CellField>{{"<U & \"p\">", 1, {&value, 1}}});

    EXPECT_TRUE(VtkFile(folder / "a.vtu").has("&lt;U &amp; &quot;p&quot;&gt;"));
}

TEST(VtkCells, FieldOfTheWrongSizeIsRefused)
{
    Folder const folder;
    VtkCells const cells(Block(2, 1, 1).mesh());
    std::vector<double> const values(3);

    EXPECT_THROW(cells.write(folder / "a.vtu", 0, std::vector<CellField>{{"a", 1, values}}), std::invalid_argument);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.vtu"));
}

TEST(VtkCells, FullDiskIsNamedAndLeavesNoHalfFile)
{
    Folder const folder;
    VtkCells const cells(Block(20, 20, 20).mesh());

    std::string const message = message_of(
        [&]
        {
            FullDisk const disk(1000);
            cells.write(folder / "a.vtu", 0, {});
        });

    EXPECT_THAT(message, HasSubstr("cannot write " + (folder / "a.vtu").string()));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "output/OutputFile.hpp"

#include <gtest/gtest.h>

#include "Files.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;
using output::OutputFile;

TEST(OutputFile, AppearsOnlyWhenCommitted)
{
    Folder const folder;
    OutputFile out(folder / "a.txt");

    out.write("one ");
    out.write("two");
    bool const was_there = std::filesystem::exists(folder / "a.txt");
    out.commit(OutputFile::Durability::machine);

    EXPECT_FALSE(was_there);
    EXPECT_EQ(read_text(folder / "a.txt"), "one two");
}

TEST(OutputFile, LeavesTheOlderFileAndNothingElseWithoutCommit)
{
    Folder const folder;
    write_text(folder / "a.txt", "old");

    {
        OutputFile out(folder / "a.txt");
        out.write("new");
    }

    EXPECT_EQ(read_text(folder / "a.txt"), "old");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt.part"));
}

TEST(OutputFile, FullDiskIsNamedAndTheOlderFileStays)
{
    Folder const folder;
    write_text(folder / "a.txt", "old");
    std::string const text(10000, 'x');

    std::string const message = message_of(
        [&]
        {
            FullDisk const disk(4096);
            OutputFile out(folder / "a.txt");
            out.write(text);
            out.commit();
        });

    EXPECT_EQ(message, "cannot write " + (folder / "a.txt").string() +
                           " (File too large); free some space or choose another folder");
    EXPECT_EQ(read_text(folder / "a.txt"), "old");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt.part"));
}

TEST(OutputFile, AbsentFolderIsNamed)
{
    Folder const folder;

    std::string const message = message_of([&] { OutputFile out(folder / "no/a.txt"); });

    EXPECT_EQ(message,
              "cannot write " + (folder / "no/a.txt").string() + " (No such file or directory); check the path");
}

TEST(MakeFolder, FileInTheWayIsNamed)
{
    Folder const folder;
    write_text(folder / "a", "a file");

    std::string const message = message_of([&] { output::make_folder(folder / "a/b"); });

    EXPECT_EQ(message, "cannot create the folder " + (folder / "a/b").string() + " (Not a directory); check the path");
}

}  // namespace

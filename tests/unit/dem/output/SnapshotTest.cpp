// SPDX-License-Identifier: BSD-3-Clause
#include "output/Snapshot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Files.hpp"
#include "output/SnapshotSeal.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;
using output::SnapshotReader;
using output::SnapshotWriter;
using testing::HasSubstr;

void write_bed(std::filesystem::path const& file)
{
    std::vector<double> const position = {0.1, 0.2, 0.3, 1e-300, -0.0, 5};
    std::vector<std::int64_t> const id = {7, 5'000'000'000};
    std::vector<std::int32_t> const material = {0, 1};
    SnapshotWriter writer(file, "settled bed");
    writer.add("position", position, 3);
    writer.add("id", id);
    writer.add("material", material);
    writer.add("contacts/spring", std::span<double const>(), 3);
    writer.set("time", 0.125);
    writer.set("steps", std::int64_t{5000});
    writer.set("case", std::string("bed"));
    writer.commit();
}

std::string refusal(std::filesystem::path const& file, std::string const& kind = "settled bed")
{
    return message_of([&] { SnapshotReader reader(file, kind); });
}

TEST(Snapshot, ReadsBackWhatWasWritten)
{
    Folder const folder;
    write_bed(folder / "new/bed.h5");

    SnapshotReader const reader(folder / "new/bed.h5", "settled bed");

    auto const position = reader.doubles("position");
    EXPECT_EQ(position, (std::vector<double>{0.1, 0.2, 0.3, 1e-300, -0.0, 5}));
    EXPECT_TRUE(std::signbit(position[4]));
    EXPECT_EQ(reader.components("position"), 3);
    EXPECT_EQ(reader.int64s("id"), (std::vector<std::int64_t>{7, 5'000'000'000}));
    EXPECT_EQ(reader.components("id"), 1);
    EXPECT_EQ(reader.int32s("material"), (std::vector<std::int32_t>{0, 1}));
    EXPECT_TRUE(reader.doubles("contacts/spring").empty());
    EXPECT_EQ(reader.components("contacts/spring"), 3);
    EXPECT_EQ(reader.number("time"), 0.125);
    EXPECT_EQ(reader.integer("steps"), 5000);
    EXPECT_EQ(reader.text("case"), "bed");
}

TEST(Snapshot, EqualStatesGiveEqualBytes)
{
    Folder const folder;

    write_bed(folder / "a.h5");
    write_bed(folder / "b.h5");

    EXPECT_EQ(read_text(folder / "a.h5"), read_text(folder / "b.h5"));
}

TEST(Snapshot, AbsentNamesAndOtherTypesAreRefused)
{
    Folder const folder;
    write_bed(folder / "bed.h5");
    SnapshotReader const reader(folder / "bed.h5", "settled bed");

    EXPECT_TRUE(reader.has("position"));
    EXPECT_TRUE(reader.has("time"));
    EXPECT_TRUE(reader.has("contacts/spring"));
    EXPECT_FALSE(reader.has("velocity"));
    EXPECT_FALSE(reader.has("groups/absent"));
    EXPECT_THAT(message_of([&] { reader.doubles("velocity"); }), HasSubstr("has no array \"velocity\""));
    EXPECT_THAT(message_of([&] { reader.int64s("position"); }), HasSubstr("an array \"position\" of another type"));
    EXPECT_THAT(message_of([&] { reader.number("height"); }), HasSubstr("has no value \"height\""));
    EXPECT_THAT(message_of([&] { reader.integer("time"); }), HasSubstr("a value \"time\" of another type"));
    EXPECT_THAT(message_of([&] { reader.text("time"); }), HasSubstr("a value \"time\" of another type"));
}

TEST(Snapshot, NothingIsWrittenWithoutCommit)
{
    Folder const folder;

    {
        SnapshotWriter writer(folder / "bed.h5", "settled bed");
        writer.set("time", 1.0);
    }

    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Snapshot, AbsentFileIsNamed)
{
    Folder const folder;

    EXPECT_EQ(refusal(folder / "bed.h5"), "snapshot " + (folder / "bed.h5").string() +
                                              " cannot be read (No such file or directory); check the path");
}

TEST(Snapshot, FileOfAnotherFormatIsRefused)
{
    Folder const folder;
    write_text(folder / "bed.h5", std::string(2000, 'x'));

    EXPECT_THAT(refusal(folder / "bed.h5"), HasSubstr("is not a snapshot"));
}

TEST(Snapshot, CutAnywhereIsRefused)
{
    Folder const folder;
    write_bed(folder / "bed.h5");
    std::string const whole = read_text(folder / "bed.h5");

    for (std::size_t const size : {std::size_t{0}, std::size_t{5}, std::size_t{100}, std::size_t{511}, std::size_t{512},
                                   whole.size() / 2, whole.size() - 1})
    {
        write_text(folder / "cut.h5", whole.substr(0, size));

        EXPECT_THAT(refusal(folder / "cut.h5"), HasSubstr("is cut short")) << size << " bytes";
    }
    write_text(folder / "cut.h5", whole + 'x');
    EXPECT_THAT(refusal(folder / "cut.h5"), HasSubstr("is cut short")) << "one byte too many";
}

TEST(Snapshot, FlippedBitAnywhereIsRefused)
{
    Folder const folder;
    write_bed(folder / "bed.h5");
    std::string const whole = read_text(folder / "bed.h5");

    for (std::size_t at = 0; at < whole.size(); at += at < 600 ? 5 : 101)
    {
        std::string bad = whole;
        bad[at] = static_cast<char>(bad[at] ^ 1);
        write_text(folder / "bad.h5", bad);

        EXPECT_THAT(refusal(folder / "bad.h5"), HasSubstr(at < 16 ? "is not a snapshot" : "is damaged"))
            << "byte " << at;
    }
}

TEST(Snapshot, OtherKindIsRefused)
{
    Folder const folder;
    write_bed(folder / "bed.h5");

    EXPECT_EQ(refusal(folder / "bed.h5", "checkpoint"), "snapshot " + (folder / "bed.h5").string() +
                                                            " is of the kind \"settled bed\" (\"checkpoint\" is "
                                                            "needed); check the path");
}

TEST(Snapshot, OtherVersionIsRefused)
{
    Folder const folder;
    std::string const content = "content of a later format";
    write_text(folder / "bed.h5", output::make_seal(2, "settled bed", std::as_bytes(std::span(content))) + content);

    EXPECT_EQ(refusal(folder / "bed.h5"), "snapshot " + (folder / "bed.h5").string() +
                                              " has version 2 (this program reads version 1); remove it, so that it "
                                              "is made again");
}

TEST(Snapshot, FullDiskIsNamedAndTheOlderSnapshotStays)
{
    Folder const folder;
    write_bed(folder / "bed.h5");

    std::string const message = message_of(
        [&]
        {
            FullDisk const disk(1000);
            write_bed(folder / "bed.h5");
        });

    EXPECT_THAT(message, HasSubstr("cannot write " + (folder / "bed.h5").string() + " (File too large)"));
    EXPECT_EQ(refusal(folder / "bed.h5"), "no error");
}

TEST(Snapshot, ArrayThatIsNoWholeNumberOfRowsIsRefused)
{
    Folder const folder;
    std::vector<double> const values(5);
    SnapshotWriter writer(folder / "bed.h5", "settled bed");

    EXPECT_THROW(writer.add("position", values, 3), std::invalid_argument);
}

}  // namespace

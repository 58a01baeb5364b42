// SPDX-License-Identifier: BSD-3-Clause
/// Files that are no checkpoint of the case are refused, and change nothing.
#include "CheckpointRun.hpp"
#include "engine/StateFile.hpp"
#include "output/Snapshot.hpp"

namespace
{

using gimdem::Case;
using namespace gimdem::test;

TEST_F(CheckpointTest, DamagedFilesAreRefused)
{
    EXPECT_NE(refusal().find("cannot be read"), std::string::npos);
    ShortRun run(serial);
    run.run_to(100);
    run.write(file);
    EXPECT_EQ(refusal(), "");
    std::string const good = bytes();
    put(good.substr(0, good.size() / 2));
    EXPECT_NE(refusal().find("is cut short"), std::string::npos);
    std::string flipped = good;
    flipped[flipped.size() / 3] ^= 1;
    put(flipped);
    std::string const message = refusal();
    EXPECT_NE(message.find("is damaged"), std::string::npos) << message;
    EXPECT_NE(message.find("restart from another checkpoint"), std::string::npos) << message;
}

TEST_F(CheckpointTest, OtherVersionsAndKindsAreRefused)
{
    std::filesystem::create_directories(file.parent_path());
    {
        gimdem::output::SnapshotWriter other(file, "checkpoint");
        other.set("checkpoint_version", gimdem::checkpoint_version + 1);
        other.commit();
    }
    EXPECT_NE(refusal().find("has version " + std::to_string(gimdem::checkpoint_version + 1)), std::string::npos)
        << refusal();
    {
        gimdem::output::SnapshotWriter bed(file, "settled bed");
        bed.commit();
    }
    EXPECT_NE(refusal().find("is of the kind \"settled bed\""), std::string::npos);
}

TEST_F(CheckpointTest, AnotherCaseIsRefused)
{
    ShortRun run(serial);
    run.write(file);
    Case other = busy_case();
    other.identity = "busy 2";
    other.title = "other";
    std::string const message = refusal(other);
    EXPECT_NE(message.find("belongs to another case: \"busy\""), std::string::npos) << message;
}

TEST_F(CheckpointTest, ArraysThatDoNotFitAreRefused)
{
    // Whole and unharmed, but with particles of a second material, for a system that has one.
    ShortRun run(serial), untouched(serial), other(serial);
    run.run_to(200);
    run.write(file);
    gimdem::output::SnapshotReader const reader(file, "checkpoint");
    EXPECT_THROW(gimdem::take_state(reader, 1, other.system), gimdem::UserError);
    expect_same(other, untouched);
}

}  // namespace

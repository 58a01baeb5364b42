// SPDX-License-Identifier: BSD-3-Clause
#include "transport/SharedMemory.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>

#include "Faults.hpp"
#include "SharedMemoryNames.hpp"
#include "transport/SendMemory.hpp"

namespace gimdem::coupling::transport
{
namespace
{

using test::shared_memory_names;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::size_t constexpr bytes = 3 * 65536;
std::string const digits(32, '7');

std::filesystem::path file_of(OwnSegment const& segment)
{
    return test::shared_memory_folder / segment.notice().name.substr(1);
}

TEST(SharedMemory, IsReadWhereItWasWrittenAndHasNoNameFromThenOn)
{
    auto own = make_segment(bytes).segment;
    ASSERT_TRUE(own);
    struct stat status = {};
    ASSERT_EQ(::stat(file_of(*own).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600u);

    auto const reader = map_segment(own->notice()).segment;
    ASSERT_TRUE(reader);
    EXPECT_THAT(shared_memory_names(), IsEmpty());
    std::strcpy(reinterpret_cast<char*>(own->memory().data()) + 1000, "one copy");
    own.reset();
    EXPECT_STREQ(reinterpret_cast<char const*>(reader->data()) + 1000, "one copy") << "it outlives its writer";
}

TEST(SharedMemory, ThatNobodyMappedHasNoNameOnceItsWriterIsGone)
{
    {
        auto const own = make_segment(bytes).segment;
        EXPECT_THAT(shared_memory_names(), SizeIs(1));
    }
    EXPECT_THAT(shared_memory_names(), IsEmpty());
}

TEST(SharedMemory, ThatIsNotThereOrIsAnotherUsersIsAnObstacleAndNoFault)
{
    EXPECT_THAT(map_segment({"/gimdem-1-" + digits, bytes}).obstacle, HasSubstr("cannot be opened"));
    EXPECT_THAT(make_segment(max_segment_bytes + 1).obstacle, HasSubstr("out of range"));

    auto const own = make_segment(bytes).segment;
    bool const root = ::geteuid() == 0;
    ASSERT_EQ(root ? ::chown(file_of(*own).c_str(), 1, 1) : ::chmod(file_of(*own).c_str(), 0), 0);
    auto const mapped = map_segment(own->notice());
    EXPECT_FALSE(mapped.segment);
    EXPECT_THAT(mapped.obstacle, HasSubstr(root ? "belongs to another user" : "cannot be opened"));
}

TEST(SharedMemory, OfAnotherNameIsRefused)
{
    for (std::string const& name : {"gimdem-1-" + digits, "/gimdem-1-" + digits + "7", "/gimdem-1-" + digits.substr(1),
                                    "/gimdem--" + digits, "/gimdem-x-" + digits, "/gimdem-1-" + std::string(32, 'A'),
                                    "/gimdem-../" + digits, std::string("/sem.other"), std::string()})
        EXPECT_FAULT(map_segment({name, bytes}), Fault::protocol, "is none of ours") << name;
}

TEST(SharedMemory, OfAnotherSizeThanAnnouncedIsRefused)
{
    auto const own = make_segment(bytes).segment;
    SegmentNotice notice = own->notice();
    notice.bytes = bytes + 1;
    EXPECT_FAULT(map_segment(notice), Fault::protocol, "has 196608 bytes instead of the 196609 that were announced");
    notice.bytes = 0;
    EXPECT_FAULT(map_segment(notice), Fault::protocol, "segment of 0 bytes");
    notice.bytes = max_segment_bytes + 1;
    EXPECT_FAULT(map_segment(notice), Fault::protocol, "segment of 17179869185 bytes");
}

TEST(SendMemory, GivesEachMessageThatIsSentASlotOfItsOwn)
{
    SendMemory const memory;
    EXPECT_FALSE(memory.offset_of(memory.make(40000))) << "no segment yet";
    memory.use(make_segment(segment_bytes(65536)).segment);
    for (std::size_t const slot : {0, 1, 2, 0, 1})
    {
        for (int attempt = 0; attempt < 2; ++attempt)  // what was packed and not sent is forgotten
        {
            memory.begin_message();
            EXPECT_EQ(memory.offset_of(memory.make(20001)), slot * 65536);
            EXPECT_EQ(memory.offset_of(memory.make(20000)), slot * 65536 + 20032) << "the next multiple of 64";
        }
        memory.message_sent();
    }
}

TEST(SendMemory, GivesAnOrdinaryFrameToWhatIsSmallOrDoesNotFit)
{
    SendMemory const memory;
    memory.use(make_segment(segment_bytes(65536)).segment);
    memory.begin_message();
    EXPECT_FALSE(memory.offset_of(memory.make(least_shared_bytes - 1)));
    EXPECT_FALSE(memory.offset_of(memory.make(65537)));
    EXPECT_EQ(memory.offset_of(memory.make(65536)), 0u) << "a whole slot";
    Frame const beyond = memory.make(least_shared_bytes);
    EXPECT_FALSE(memory.offset_of(beyond)) << "the slot is full";
    EXPECT_EQ(beyond.size(), least_shared_bytes);
}

}  // namespace
}  // namespace gimdem::coupling::transport

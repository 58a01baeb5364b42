// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Mailbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "Faults.hpp"

namespace gimdem::coupling::transport
{
namespace
{

using namespace std::chrono_literals;
using Packing = Postbox::Packing;

Frame frame(std::string const& text)
{
    return Frame(text.data(), text.size());
}

struct Mailbox : testing::Test
{
    std::shared_ptr<OwnSegment> own = make_segment(2 * mailbox_bytes).segment;
    Outbox outbox{own};
    Postbox postbox{map_segment(own->notice()).segment};

    std::string look()
    {
        auto const envelope = postbox.look();
        return envelope ? envelope->to_string() : "(nothing)";
    }
};

TEST_F(Mailbox, ShowsAnEnvelopeOnceWhileItsArraysArePacked)
{
    EXPECT_EQ(look(), "(nothing)");
    outbox.announce(frame("first"));
    EXPECT_EQ(look(), "first");
    EXPECT_EQ(look(), "(nothing)") << "seen already";
    EXPECT_EQ(postbox.packing(), Packing::going_on);

    Time const before = Clock::now();
    outbox.finish();
    EXPECT_EQ(postbox.packing(), Packing::complete);
    Time const posted = postbox.posted();
    EXPECT_GE(posted, before);
    EXPECT_LE(posted, Clock::now());
    EXPECT_EQ(look(), "(nothing)");

    outbox.announce(frame("second"));
    outbox.finish();
    EXPECT_EQ(look(), "second") << "also when it is complete already";
    EXPECT_EQ(postbox.packing(), Packing::complete);
}

TEST_F(Mailbox, TellsHowManyArraysArePacked)
{
    std::vector<std::size_t> told;
    auto const note = [&](std::size_t arrays)
    {
        if (told.empty() || told.back() != arrays) told.push_back(arrays);
    };
    for (int message = 0; message < 2; ++message)  // it starts anew each time
    {
        told.clear();
        outbox.announce(frame("arrays"));
        ASSERT_EQ(look(), "arrays");
        for (std::size_t const arrays : {0, 1, 3})
        {
            if (arrays > 0) outbox.pack(arrays);
            EXPECT_EQ(postbox.packing(note), Packing::going_on);
        }
        outbox.finish();
        EXPECT_EQ(postbox.packing(note), Packing::complete);
        EXPECT_THAT(told, testing::ElementsAre(1, 3));
    }
}

TEST_F(Mailbox, DropsWhatIsAbandoned)
{
    outbox.announce(frame("diverged"));
    EXPECT_EQ(look(), "diverged");
    outbox.abandon();
    EXPECT_EQ(postbox.packing(), Packing::abandoned);
    EXPECT_EQ(look(), "(nothing)");

    outbox.announce(frame("again"));
    outbox.abandon();
    EXPECT_EQ(look(), "(nothing)") << "abandoned before anyone looked";

    outbox.announce(frame("old"));
    EXPECT_EQ(look(), "old");
    outbox.abandon();
    outbox.announce(frame("new"));
    EXPECT_EQ(postbox.packing(), Packing::abandoned) << "that message, whatever came after it";
    outbox.finish();
    EXPECT_EQ(look(), "new");
    EXPECT_EQ(postbox.packing(), Packing::complete);
}

TEST_F(Mailbox, WakesItsReader)
{
    Time const start = Clock::now();
    std::thread writer(
        [&]
        {
            std::this_thread::sleep_for(30ms);
            outbox.announce(frame("now"));
        });
    while (look() != "now" && Clock::now() < start + 10s)
        postbox.wait(start + 10s);
    writer.join();
    EXPECT_LT(Clock::now() - start, 5s) << "it did not sleep until the end";
    EXPECT_GE(Clock::now() - start, 30ms);
}

TEST_F(Mailbox, KnockWakesItsReaderAndIsNoMessage)
{
    std::atomic<bool> is_over = false;
    std::thread writer(
        [&]
        {
            while (!is_over)  // again and again: a knock before it sleeps is not heard
            {
                std::this_thread::sleep_for(5ms);
                outbox.knock();
            }
        });
    Time const start = Clock::now();
    postbox.wait(start + 10s);
    EXPECT_LT(Clock::now() - start, 5s) << "it did not sleep until the end";
    EXPECT_EQ(look(), "(nothing)");
    is_over = true;
    writer.join();
    outbox.announce(frame("after the knocks"));
    EXPECT_EQ(look(), "after the knocks");
}

TEST_F(Mailbox, IsNotWaitedForLongerThanAsked)
{
    Time const start = Clock::now();
    postbox.wait(start + 20ms);
    EXPECT_LT(Clock::now() - start, 5s);
    postbox.wait(start);  // the past
}

TEST_F(Mailbox, RefusesAnEnvelopeThatIsTooLong)
{
    outbox.announce(frame("short"));
    std::uint32_t const long_one = max_posted_bytes + 1;
    std::memcpy(own->memory().data() + mailbox_bytes + 4, &long_one, sizeof(long_one));
    EXPECT_FAULT(postbox.look(), Fault::protocol, "4069 bytes in a mailbox of 4068");
}

TEST_F(Mailbox, BelievesNoClockButItsOwn)
{
    outbox.announce(frame("x"));
    outbox.finish();
    std::int64_t const future = std::int64_t{1} << 62;
    std::memcpy(own->memory().data() + mailbox_bytes + 8, &future, sizeof(future));
    Time const posted = postbox.posted();
    EXPECT_LE(posted, Clock::now());
}

TEST(MailboxOfASmallSegment, IsRefused)
{
    auto const own = make_segment(mailbox_bytes - 64).segment;
    EXPECT_FAULT(Postbox(map_segment(own->notice()).segment), Fault::protocol, "4032 bytes has no mailbox");
}

}  // namespace
}  // namespace gimdem::coupling::transport

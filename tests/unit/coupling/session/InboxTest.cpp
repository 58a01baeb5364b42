// SPDX-License-Identifier: BSD-3-Clause
#include "session/Inbox.hpp"

#include <gtest/gtest.h>

#include "message/Control.hpp"

namespace gimdem::coupling::session
{
namespace
{

using message::Kind;
using transport::Clock;
using transport::ticks;

double constexpr patience = 20;  ///< [s]

Letter letter(std::string const& reason)
{
    return {message::pack_goodbye(reason), std::nullopt, Clock::now()};
}

std::string next_reason(Inbox& inbox)
{
    Delivery const delivery = inbox.wait(Clock::now() + ticks(patience));
    return delivery.letter ? message::unpack_goodbye(delivery.letter->message) : "(no letter)";
}

TEST(Inbox, GivesLettersInOrderAndTheEndingLast)
{
    Inbox inbox;
    inbox.put(letter("one"));
    inbox.put(letter("two"));
    inbox.end({transport::Ending::Kind::silent, 3, ""});

    EXPECT_EQ(next_reason(inbox), "one");
    EXPECT_EQ(next_reason(inbox), "two");
    for (int again = 0; again < 2; ++again)
    {
        Delivery const delivery = inbox.wait(Clock::now() + ticks(patience));
        EXPECT_FALSE(delivery.letter);
        ASSERT_TRUE(delivery.ending);
        EXPECT_EQ(delivery.ending->silence, 3);
    }
}

TEST(Inbox, GivesNothingWhenTheTimeIsUp)
{
    Inbox inbox;
    Delivery const delivery = inbox.wait(Clock::now() + ticks(0.01));
    EXPECT_FALSE(delivery.letter);
    EXPECT_FALSE(delivery.ending);
    EXPECT_FALSE(inbox.wait_for_contact(Clock::now() + ticks(0.01)));
}

TEST(Inbox, ShowsTheKindOfTheFirstLetter)
{
    Inbox inbox;
    EXPECT_EQ(inbox.peek(), std::nullopt);
    inbox.put(letter("one"));
    EXPECT_EQ(inbox.peek(), Kind::kGoodbye);
    EXPECT_EQ(next_reason(inbox), "one") << "looking takes nothing away";

    inbox.put({{}, CouplingError(Fault::protocol, "rubbish"), Clock::now()});
    EXPECT_EQ(inbox.peek(), Kind::KIND_NOT_SET);
}

TEST(Inbox, CountsHeartbeatsAndLettersAndTheEndingAsContact)
{
    for (int way = 0; way < 3; ++way)
    {
        Inbox inbox;
        if (way == 0) inbox.note_contact();
        if (way == 1) inbox.put(letter("one"));
        if (way == 2) inbox.end({});
        EXPECT_TRUE(inbox.wait_for_contact(Clock::now() + ticks(patience))) << way;
    }
}

TEST(Inbox, KeepsNoMoreThanAFewUnreadLetters)
{
    Inbox inbox;
    for (int k = 0; k < 1000; ++k)
        inbox.put(letter(std::to_string(k)));
    inbox.end({});
    int kept = 0;
    while (next_reason(inbox) == std::to_string(kept))
        ++kept;
    EXPECT_EQ(kept, 16);
}

TEST(Inbox, KeepsNoMoreThanTwoUnreadLettersWithArrays)
{
    Inbox inbox;
    for (int k = 0; k < 4; ++k)
    {
        Letter large = letter("large " + std::to_string(k));
        large.message.arrays.emplace_back(8);
        inbox.put(std::move(large));
    }
    inbox.put(letter("small"));

    EXPECT_EQ(next_reason(inbox), "large 0");
    EXPECT_EQ(next_reason(inbox), "large 1");
    EXPECT_EQ(next_reason(inbox), "small");
}

}  // namespace
}  // namespace gimdem::coupling::session

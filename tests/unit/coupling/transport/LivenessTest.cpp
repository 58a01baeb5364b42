// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Liveness.hpp"

#include <gtest/gtest.h>

namespace gimdem::coupling::transport
{
namespace
{

double constexpr timeout = 10;  ///< [s]

Time at(double seconds)
{
    return Time() + ticks(seconds);
}

/// Turns the polling loop once a second from one time to another.
void turn(Liveness& liveness, int from, int to)
{
    for (int second = from; second <= to; ++second)
        liveness.turn(at(second));
}

TEST(Liveness, WatchesNobodyBeforeContact)
{
    Liveness liveness(timeout, at(0));
    turn(liveness, 1, 100);

    EXPECT_FALSE(liveness.silence(at(100)));
    EXPECT_FALSE(liveness.beat_due(at(100)));
}

TEST(Liveness, BeatsAtOnceOnContactThenFiveTimesPerTimeout)
{
    Liveness liveness(timeout, at(0));
    liveness.heard(at(1));
    EXPECT_TRUE(liveness.beat_due(at(1)));
    liveness.beaten(at(1));
    EXPECT_FALSE(liveness.beat_due(at(2.9)));
    EXPECT_TRUE(liveness.beat_due(at(3)));
}

TEST(Liveness, FollowsTheLessPatientPeer)
{
    Liveness liveness(timeout, at(0));
    liveness.heard(at(0));
    liveness.beaten(at(0));
    liveness.set_peer_timeout(1);
    EXPECT_TRUE(liveness.beat_due(at(0.2)));
    EXPECT_FALSE(liveness.beat_due(at(0.19)));

    liveness.set_peer_timeout(100);
    liveness.beaten(at(1));
    EXPECT_TRUE(liveness.beat_due(at(1.2))) << "a patient peer must not make the beats rarer";
}

TEST(Liveness, CallsAPeerSilentAfterTheTimeout)
{
    Liveness liveness(timeout, at(0));
    liveness.heard(at(5));
    turn(liveness, 1, 15);
    EXPECT_FALSE(liveness.silence(at(15)));
    turn(liveness, 16, 16);
    ASSERT_TRUE(liveness.silence(at(16)));
    EXPECT_NEAR(*liveness.silence(at(16)), 11, 1e-6);  // clock ticks are nanoseconds
}

TEST(Liveness, BlamesNoPeerForOurOwnPause)
{
    Liveness liveness(timeout, at(0));
    liveness.heard(at(1));
    turn(liveness, 1, 2);

    liveness.turn(at(100));  // we were stopped for 98 s

    EXPECT_FALSE(liveness.silence(at(100)));
    turn(liveness, 101, 110);
    EXPECT_FALSE(liveness.silence(at(110)));
    turn(liveness, 111, 111);
    EXPECT_TRUE(liveness.silence(at(111)));
}

TEST(Liveness, TurnsInTimeForEachDuty)
{
    Liveness liveness(timeout, at(0));
    EXPECT_EQ(liveness.next_turn(at(0)), at(2));
    liveness.heard(at(0));
    EXPECT_EQ(liveness.next_turn(at(0)), at(0)) << "a beat is due";
    liveness.beaten(at(8.5));
    EXPECT_EQ(liveness.next_turn(at(8.5)), at(10)) << "the silence would be too long then";
    EXPECT_EQ(liveness.next_turn(at(10)), at(10.5)) << "the next beat";
}

}  // namespace
}  // namespace gimdem::coupling::transport

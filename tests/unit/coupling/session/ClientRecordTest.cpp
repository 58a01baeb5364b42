// SPDX-License-Identifier: BSD-3-Clause
/// When a client's step did what, from times that go in.
#include "session/ClientRecord.hpp"

#include <gtest/gtest.h>

#include "message/ClockMessages.hpp"
#include "message/Control.hpp"
#include "message/StepMessages.hpp"

namespace gimdem::coupling::session
{
namespace
{

Time at(double seconds)
{
    return Time() + transport::ticks(seconds);
}

/// A record that knows the server's clock, and what it tells of its last step.
struct RecordOf : testing::Test
{
    RecordOf()
    {
        message::Message answer = message::pack(message::SolidState{}, message::Terms{});
        message::put(message::ClockReading{1, 1, 0, 0}, answer);
        record.heard(answer, at(1), at(1));
    }

    ClientTimes told()
    {
        message::Message fluid = message::pack(FluidState{}, message::Terms{});
        record.put_into_fluid(fluid);
        EXPECT_TRUE(fluid.envelope.fluid_state().has_previous_times());
        return message::unpack_times(fluid.envelope.fluid_state().previous_times());
    }
    /// Of a serial step from 10 s to 20 s in begin_step(), of which 4 s were waiting, with the fluid sent and its
    /// answer there at these times [s].
    ClientTimes waited(double sent, double arrival)
    {
        record.began(3, at(10), at(20));
        record.waited_in_begin(at(sent), at(arrival), 4);
        record.ended(at(25), at(26), 0);
        return told();
    }

    ClientRecord record;
};

TEST_F(RecordOf, AStepTellsItsStations)
{
    ClientTimes const times = waited(11, 19);
    EXPECT_EQ(times.step, 3);
    EXPECT_EQ(times.begun, 10);
    EXPECT_EQ(times.resumed, 20);
    EXPECT_EQ(times.ended, 25);
    EXPECT_EQ(times.closed, 26);
}

TEST_F(RecordOf, WaitingLiesAroundTheMiddleAndWithinTheCall)
{
    EXPECT_EQ(waited(12, 18).wait_from, 13);
    EXPECT_EQ(waited(12, 18).wait_to, 17);
    EXPECT_EQ(waited(18, 20).wait_from, 16);
    EXPECT_EQ(waited(18, 20).wait_to, 20);
    EXPECT_EQ(waited(10, 12).wait_from, 10);
    EXPECT_EQ(waited(10, 12).wait_to, 14);
}

TEST_F(RecordOf, WaitingInEndStepBeginsWithIt)
{
    record.began(3, at(10), at(11));
    record.ended(at(25), at(30), 4);
    EXPECT_EQ(told().wait_from, 25);
    EXPECT_EQ(told().wait_to, 29);
}

TEST_F(RecordOf, ALastStepGoesIntoTheGoodbye)
{
    message::Message early = message::pack_goodbye("early");
    record.put_into_goodbye(early, {});
    EXPECT_FALSE(early.envelope.goodbye().has_last_step()) << "none is complete";

    waited(11, 19);
    message::Message goodbye = message::pack_goodbye("done");
    record.put_into_goodbye(goodbye, {2, 0, 0.5});
    auto const last = message::unpack_last_step(goodbye);
    ASSERT_TRUE(last);
    EXPECT_EQ(last->times.step, 3);
    EXPECT_EQ(last->timings.compute, 2);
    EXPECT_EQ(last->timings.output, 0.5);
}

}  // namespace
}  // namespace gimdem::coupling::session

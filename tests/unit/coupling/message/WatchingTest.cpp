// SPDX-License-Identifier: BSD-3-Clause
/// What messages tell those who watch a run: clocks, times of steps, the status; and what of it is refused.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>

#include "Faults.hpp"
#include "message/ClockMessages.hpp"
#include "message/Codec.hpp"
#include "message/Greeting.hpp"
#include "message/StatusMessages.hpp"
#include "message/StepMessages.hpp"

namespace gimdem::coupling::message
{
namespace
{

Message over_the_wire(Message message)
{
    return decode(encode(std::move(message)));
}

TEST(ClockReading, ComesBackFromEveryMessageThatHasOne)
{
    std::array<Message, 3> messages{pack(Hello{"a client", {}, {}, std::nullopt, 1}),
                                    pack(Welcome{"a server", "a title", Schedule::serial, 0.1, {}}),
                                    pack(SolidState{}, Terms{})};
    for (Message& message : messages)
    {
        EXPECT_FALSE(clock_reading(message)) << describe(message);
        put(ClockReading{1.5, 2.5, 0.5, 7}, message);
        auto const got = clock_reading(over_the_wire(std::move(message)));
        ASSERT_TRUE(got);
        EXPECT_EQ(got->received, 1.5);
        EXPECT_EQ(got->sent, 2.5);
        EXPECT_EQ(got->origin, 0.5);
        EXPECT_EQ(got->machine, 7u);
    }
}

v1::StepTimes good_times()
{
    v1::StepTimes body;
    put(ClientTimes{3, 1, 2, 4, 6, 1.5, 3}, ClockOffset{-5, 0.25}, body);
    return body;
}

TEST(ClientTimes, ComeBack)
{
    ClientTimes const times = unpack_times(good_times());
    EXPECT_EQ(times.step, 3);
    EXPECT_EQ(times.begun, 1);
    EXPECT_EQ(times.resumed, 2);
    EXPECT_EQ(times.ended, 4);
    EXPECT_EQ(times.closed, 6);
    EXPECT_EQ(times.wait_from, 1.5);
    EXPECT_EQ(times.wait_to, 3);
    EXPECT_EQ(unpack_offset(good_times()).offset, -5);
    EXPECT_EQ(unpack_offset(good_times()).uncertainty, 0.25);
}

TEST(ClientTimes, ThatRunBackwardsAreRefused)
{
    struct Damage
    {
        std::function<void(v1::StepTimes&)> apply;
        std::string text;
    };
    for (Damage const& damage : {Damage{[](auto& t) { t.set_resumed(0.5); }, "times: resumed"},
                                 Damage{[](auto& t) { t.set_ended(1.5); }, "times: ended"},
                                 Damage{[](auto& t) { t.set_closed(3.5); }, "times: closed"},
                                 Damage{[](auto& t) { t.set_wait_from(0.5); }, "times: wait_from"},
                                 Damage{[](auto& t) { t.set_wait_to(1.25); }, "times: wait_to"}})
    {
        v1::StepTimes body = good_times();
        damage.apply(body);
        EXPECT_FAULT(unpack_times(body), Fault::protocol, damage.text);
    }
    v1::StepTimes body = good_times();
    body.set_uncertainty(-0.1);
    EXPECT_FAULT(unpack_offset(body), Fault::protocol, "times: uncertainty");
}

TEST(Status, ComesBackWhole)
{
    Status sent;
    sent.server = "a server";
    sent.state = "ready";
    sent.state_time = 1.5;
    sent.uptime = 8;
    sent.memory = 1e7;
    sent.process = 42;
    sent.step = 3;
    sent.client = "a client";
    sent.client_state = "waiting";
    sent.client_silence = 0.25;
    sent.clock = {-5, 0.5};
    sent.run.folder = "/runs/0001";
    sent.run.schedule = "serial";
    sent.run.steps_per_second = 12;

    Status const got = unpack_status(over_the_wire(pack(sent)));

    EXPECT_EQ(got.server, sent.server);
    EXPECT_EQ(got.state, sent.state);
    EXPECT_EQ(got.state_time, sent.state_time);
    EXPECT_EQ(got.uptime, sent.uptime);
    EXPECT_EQ(got.memory, sent.memory);
    EXPECT_EQ(got.process, sent.process);
    EXPECT_EQ(got.step, sent.step);
    EXPECT_EQ(got.client, sent.client);
    EXPECT_EQ(got.client_state, sent.client_state);
    EXPECT_EQ(got.client_silence, sent.client_silence);
    EXPECT_EQ(got.clock.offset, sent.clock.offset);
    EXPECT_EQ(got.clock.uncertainty, sent.clock.uncertainty);
    EXPECT_EQ(got.run.folder, sent.run.folder);
    EXPECT_EQ(got.run.schedule, sent.run.schedule);
    EXPECT_EQ(got.run.steps_per_second, sent.run.steps_per_second);
}

TEST(Status, OfAServerThatTalksTooMuchIsCutOrRefused)
{
    Message long_winded = pack(Status{});
    long_winded.envelope.mutable_status()->set_activity(std::string(5000, 'x'));
    EXPECT_EQ(unpack_status(long_winded).run.activity, std::string(max_name_bytes, 'x'));

    Message many = pack(Status{});
    for (int k = 0; k < 512; ++k)
        many.envelope.mutable_status()->add_figures()->set_name("f");
    EXPECT_EQ(unpack_status(many).run.figures.size(), 512u);
    many.envelope.mutable_status()->add_figures()->set_name("f");
    EXPECT_FAULT(unpack_status(many), Fault::protocol, "513 figures");
}

}  // namespace
}  // namespace gimdem::coupling::message

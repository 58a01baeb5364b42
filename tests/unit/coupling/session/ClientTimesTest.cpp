// SPDX-License-Identifier: BSD-3-Clause
/// When a step did what, as both sides tell it: in order, on one clock, and the same sums as the exchange times.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "Pair.hpp"
#include "RawMessages.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;
using namespace std::chrono_literals;

int constexpr steps = 6;

struct Seen
{
    std::vector<FluidState> states;
    std::vector<ServerTimes> times;  ///< of each answer
    std::optional<LastClientStep> last;
};

Seen serve(Server& server, Schedule schedule)
{
    Seen seen;
    server.wait_for_client(server_terms(schedule));
    auto const cells = static_cast<std::size_t>(server.receive_mesh().cell_count);
    server.accept_mesh(SolidArrays(cells, 0).view());
    while (auto fluid = server.receive_fluid())
    {
        seen.states.push_back(*fluid);
        std::this_thread::sleep_for(4ms);
        server.send_solid(SolidArrays(cells, 1).view(), {});
        seen.times.push_back(server.step_times());
    }
    seen.last = server.last_client_step();
    return seen;
}

struct Scheme
{
    std::string transport;
    Schedule schedule;
};

class StepTimesOf : public testing::TestWithParam<Scheme>
{
protected:
    bool is_serial() const { return GetParam().schedule == Schedule::serial; }
};

TEST_P(StepTimesOf, BothSidesFitTogether)
{
    double const before = clock_now();
    std::string const endpoint = GetParam().transport == "ipc" ? unused_ipc_endpoint() : any_tcp_endpoint();
    Server server(server_options(endpoint));
    auto served = in_background([&] { return serve(server, GetParam().schedule); });
    Client client(client_options(server.endpoint()));
    client.connect({1.2, 1.8e-5});
    client.send_mesh(view_of(small_mesh()));
    for (int n = 1; n <= steps; ++n)
    {
        client.begin_step(step(n), FluidArrays(24, n).view());
        std::this_thread::sleep_for(2ms);
        client.end_step({0.001, 0, 0.0005});
    }
    ExchangeTimes const exchange = client.exchange_times();
    client.finish("done");
    Seen const seen = served.get();
    double const after = clock_now();

    ASSERT_TRUE(seen.last) << "Goodbye tells of the last step";
    EXPECT_EQ(seen.last->timings.compute, 0.001);
    EXPECT_EQ(seen.last->timings.output, 0.0005);
    EXPECT_EQ(seen.states.front().previous_times.step, 0) << "there is none before the first";
    std::vector<ClientTimes> told;
    for (std::size_t n = 1; n < seen.states.size(); ++n)
        told.push_back(seen.states[n].previous_times);
    told.push_back(seen.last->times);

    double waiting = 0, calls = 0;
    for (std::size_t n = 0; n < told.size(); ++n)
    {
        ClientTimes const& at = told[n];
        EXPECT_EQ(at.step, static_cast<std::int64_t>(n + 1));
        EXPECT_GT(at.begun, n == 0 ? before : told[n - 1].closed);
        EXPECT_GE(at.resumed, at.begun);
        EXPECT_GE(at.ended, at.resumed + 0.002) << "the fluid step slept so long";
        EXPECT_GE(at.closed, at.ended);
        EXPECT_LT(at.closed, after);
        if (at.wait_to > at.wait_from)
        {
            EXPECT_GE(at.wait_from, is_serial() ? at.begun : at.ended);
            EXPECT_LE(at.wait_to, is_serial() ? at.resumed : at.closed);
        }
        waiting += at.wait_to - at.wait_from;
        calls += at.resumed - at.begun + (is_serial() ? 0 : at.closed - at.ended);

        // One machine, one clock: what the server says of the same step lies within.
        ServerTimes const& there = seen.times[n];
        EXPECT_GE(there.arrived, at.begun);
        EXPECT_GE(there.handed_out, there.arrived);
        EXPECT_GE(there.answering, there.handed_out + 0.004) << "the server slept so long";
        EXPECT_GE(there.answered, there.answering);
        EXPECT_LE(there.answering, is_serial() ? at.resumed : at.closed);
    }
    // Differences of doubles near a machine's time since its start, 1e6 s or so, have an error of 1e-10 s each.
    EXPECT_NEAR(waiting, exchange.waiting, steps * 1e-8);
    EXPECT_NEAR(calls - waiting, exchange.exchange, steps * 1e-8);
    ASSERT_TRUE(seen.states.back().clock);
    EXPECT_EQ(seen.states.back().clock->offset, 0);
    EXPECT_EQ(seen.states.back().clock->uncertainty, 0);
}

INSTANTIATE_TEST_SUITE_P(Schemes, StepTimesOf,
                         testing::Values(Scheme{"ipc", Schedule::serial}, Scheme{"ipc", Schedule::overlapped},
                                         Scheme{"tcp", Schedule::serial}, Scheme{"tcp", Schedule::overlapped}),
                         [](auto const& scheme) {
                             return scheme.param.transport +
                                    (scheme.param.schedule == Schedule::serial ? "_serial" : "_overlapped");
                         });

/// A client of protocol 1.0 tells nothing of clocks, and is told nothing.
TEST(StepTimes, OfAnOldClientAreNotToldAndNotMissed)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server, Schedule::serial); });
    RawPeer client = RawPeer::client(server.endpoint());
    client.send(raw_hello());
    auto const welcome = client.receive();
    ASSERT_TRUE(welcome && welcome->envelope.has_welcome());
    EXPECT_FALSE(welcome->envelope.welcome().has_clock());
    client.send(raw_mesh(small_mesh()));
    client.receive();  // MeshAccepted
    client.receive();  // SolidState of step 0
    std::vector<std::pair<std::string, unsigned>> const needs{{"velocity", 3}, {"pressure_gradient", 3}};
    client.send(raw_fluid(1, 0, 1e-3, 24, needs));
    client.receive();
    client.send(raw_goodbye());
    Seen const seen = served.get();
    ASSERT_EQ(seen.states.size(), 1u);
    EXPECT_EQ(seen.states[0].previous_times.step, 0);
    EXPECT_FALSE(seen.states[0].clock);
    EXPECT_FALSE(seen.last);
}

}  // namespace
}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Peers and strangers that send as much as they can: memory stays flat, and the session tells what it thinks of it.
#include <gtest/gtest.h>

#include <malloc.h>
#include <future>
#include <string>
#include <vector>

#include "Faults.hpp"
#include "Figure.hpp"
#include "Pair.hpp"
#include "Process.hpp"
#include "ProcessMeters.hpp"
#include "RawMessages.hpp"
#include "session/Inbox.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

/// ZeroMQ's batches and the threads' arenas, of both ends, which are in this process; measured: 1 MB [byte].
double constexpr flat = 16 << 20;
/// Raw peers have no heartbeat, and a busy machine is slow [s].
double constexpr forgiving = 600;

/// A server in the middle of a run, whose program is at work.
struct BusyServer
{
    explicit BusyServer(std::string const& endpoint)
        : server(server_options(endpoint, forgiving)), peer(RawPeer::client(server.endpoint()))
    {
        auto client_side = in_background(
            [&]
            {
                peer.send(raw_hello());
                peer.receive();
                peer.send(raw_mesh(small_mesh()));
                peer.receive();
                peer.receive();
                peer.send(raw_fluid(1, 0, 1e-3, 24, {{"velocity", 3}, {"pressure_gradient", 3}}));
            });
        server.wait_for_client(server_terms());
        server.receive_mesh();
        server.accept_mesh(SolidArrays(24, 2).view());
        server.receive_fluid();
        client_side.get();
    }

    Server server;
    RawPeer peer;
};

class Flood : public testing::TestWithParam<char const*>
{
protected:
    static std::string endpoint()
    {
        return GetParam() == std::string("ipc") ? unused_ipc_endpoint() : any_tcp_endpoint();
    }
};
INSTANTIATE_TEST_SUITE_P(Over, Flood, testing::Values("ipc", "tcp"),
                         [](auto const& transport) { return std::string(transport.param); });

TEST_P(Flood, OfAStrangerWhoReadsNoAnswerLeavesMemoryFlat)
{
    BusyServer busy(endpoint());
    RawPeer stranger = RawPeer::client(busy.server.endpoint());
    RawPeer second = RawPeer::client(busy.server.endpoint());
    second.send(raw_hello());
    EXPECT_THAT(second.receive_error(), testing::HasSubstr("busy"));
    double const before = own_memory();

    // Each is answered by some 200 bytes, and as much again to keep them: 40 MB in all.
    for (int n = 0; n < 100'000; ++n)
        stranger.send_frames({"x"});
    second.send(raw_hello());
    EXPECT_THAT(second.receive_error(), testing::HasSubstr("busy"));  // the server has come so far

    double const growth = own_memory() - before;
    figure("memory_growth_by_flood_of_stranger", growth, "byte");
    EXPECT_LT(growth, flat);
    busy.server.send_solid(SolidArrays(24, 5).view(), {});  // and the session goes on
    ASSERT_TRUE(busy.peer.receive());
}

TEST_P(Flood, OfThePeerLeavesMemoryFlatAndEndsTheSession)
{
    BusyServer busy(endpoint());
    double const before = own_memory();

    // 340 MB in all: the fields of a mesh of 350,000 cells, to a session of 24.
    RawMessage const fluid = raw_fluid(2, 1e-3, 1e-3, 350'000, {{"velocity", 3}});
    for (int n = 0; n < 40; ++n)
        busy.peer.send(fluid);
    busy.peer.send(raw_goodbye());
    auto const growth = [&]
    {
        ::malloc_trim(0);
        return own_memory() - before - static_cast<double>(fluid.arrays.front().size());
    };
    EXPECT_TRUE(wait_until([&] { return growth() < flat; }, forgiving / 10)) << "kept unread: " << growth();
    figure("memory_growth_by_flood_of_peer", growth(), "byte");

    EXPECT_FAULT(busy.server.send_solid(SolidArrays(24, 5).view(), {}), Fault::protocol,
                 "no message of this session has more than");
}

TEST(FloodOfLetters, WithArraysIsCut)
{
    session::Inbox inbox;
    for (int n = 0; n < 10; ++n)
    {
        message::Message message;
        message.envelope.mutable_solid_state();
        message.arrays.emplace_back(8);
        inbox.put({std::move(message), std::nullopt, transport::Clock::now()});
    }
    int kept = 0;
    while (inbox.wait(transport::Clock::now()).letter)
        ++kept;
    EXPECT_EQ(kept, 2);
}

}  // namespace
}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Fields that travel through shared memory: between our two classes, and with a raw client that uses it or abuses it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "Faults.hpp"
#include "Pair.hpp"
#include "RawSharedClient.hpp"
#include "SharedMemoryNames.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;
using testing::HasSubstr;
using testing::IsEmpty;

struct Wishes
{
    char const* name;
    bool client;
    bool server;
    Schedule schedule;
    bool compress = false;  ///< what does not lie in shared memory
};

class SharedRun : public testing::TestWithParam<Wishes>
{
};

/// The solid of step n is SolidArrays(cells, n). The fluid of a step is read after its answer was sent, as a log may.
std::vector<std::vector<double>> serve(Server& server, Schedule schedule)
{
    std::vector<std::vector<double>> velocities;
    server.wait_for_client(server_terms(schedule));
    server.receive_mesh();
    server.accept_mesh(SolidArrays(cells, 0).view());
    while (auto fluid = server.receive_fluid())
    {
        server.send_solid(SolidArrays(cells, static_cast<double>(fluid->step.number)).view(), {});
        velocities.push_back(to_vector(fluid->fields.velocity));
    }
    EXPECT_EQ(server.shared_memory_note(), "");
    return velocities;
}

TEST_P(SharedRun, ExchangesEveryNumberOfEveryStepAndLeavesNoName)
{
    int constexpr steps = 8;  // more than twice around the ring of three
    ServerOptions offered = server_options(unused_ipc_endpoint());
    offered.shared_memory = GetParam().server;
    offered.encodings.lz4 = GetParam().compress;
    Server server(offered);
    auto served = in_background([&] { return serve(server, GetParam().schedule); });
    ClientOptions options = client_options(server.endpoint());
    options.shared_memory = GetParam().client;

    Client client(options);
    client.connect({1.2, 1.8e-5});
    client.send_mesh(view_of(mesh()));
    EXPECT_THAT(shared_memory_names(), IsEmpty()) << "both are mapped";
    for (int n = 1; n <= steps; ++n)
    {
        SolidFields const solid = client.begin_step(step(n), FluidArrays(cells, n).view());
        SolidArrays const expected(cells, GetParam().schedule == Schedule::serial ? n : n - 1);
        EXPECT_EQ(to_vector(solid.void_fraction), expected.void_fraction) << "step " << n;
        EXPECT_EQ(to_vector(solid.drag_momentum), expected.drag_momentum) << "step " << n;
        client.end_step();
    }
    EXPECT_EQ(client.shared_memory_note(), "");
    client.finish("done");
    auto const velocities = served.get();
    ASSERT_EQ(velocities.size(), static_cast<std::size_t>(steps));
    for (int n = 1; n <= steps; ++n)
        EXPECT_EQ(velocities[static_cast<std::size_t>(n - 1)], FluidArrays(cells, n).velocity) << "step " << n;
    EXPECT_THAT(shared_memory_names(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Wish, SharedRun,
                         testing::Values(Wishes{"both_serial", true, true, Schedule::serial},
                                         Wishes{"both_overlapped", true, true, Schedule::overlapped},
                                         Wishes{"both_compressing", true, true, Schedule::serial, true},
                                         Wishes{"neither_compressing", false, false, Schedule::serial, true},
                                         Wishes{"client_alone", true, false, Schedule::serial},
                                         Wishes{"server_alone", false, true, Schedule::overlapped}),
                         [](auto const& wishes) { return std::string(wishes.param.name); });

TEST(SharedRunUserFault, LeavesTheSlotThatThePeerReadsAlone)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server, Schedule::overlapped); });
    Client client(client_options(server.endpoint()));
    client.connect({1.2, 1.8e-5});
    client.send_mesh(view_of(mesh()));
    FluidArrays diverged(cells, 9);
    diverged.pressure_gradient[5] = std::nan("");
    for (int n = 1; n <= 4; ++n)
    {
        for (int attempt = 0; attempt < 4; ++attempt)
            EXPECT_FAULT(client.begin_step(step(n), diverged.view()), Fault::user, "has diverged");
        client.begin_step(step(n), FluidArrays(cells, n).view());
        client.end_step();
    }
    client.finish("done");
    auto const velocities = served.get();
    ASSERT_EQ(velocities.size(), 4u);
    for (std::size_t n = 1; n <= 4; ++n)
        EXPECT_EQ(velocities[n - 1], FluidArrays(cells, static_cast<double>(n)).velocity) << "step " << n;
}

TEST(SharedMemoryRaw, TravelsByOffsetsOfBothSegments)
{
    RawSharedClient client;
    ASSERT_NO_FATAL_FAILURE(client.be_ready());
    std::vector<double> const velocity = FluidArrays(cells, 3).velocity;
    std::memcpy(client.own->memory().data() + 640, velocity.data(), velocity_bytes);
    client.peer.send(client.fluid(640));

    auto const solid = client.peer.receive();
    ASSERT_TRUE(solid && solid->envelope.has_solid_state());
    auto const& header = solid->envelope.arrays(0);
    EXPECT_TRUE(header.shared());
    EXPECT_THAT(solid->arrays.at(0), IsEmpty());
    ASSERT_LE(header.offset() + cells * sizeof(double), client.theirs->bytes());
    double last = 0;
    std::memcpy(&last, client.theirs->data() + header.offset() + (cells - 1) * sizeof(double), sizeof(last));
    EXPECT_EQ(last, 0.75);
    client.peer.send(raw_goodbye());
    EXPECT_EQ(client.end(), "(nothing)");
    EXPECT_EQ(client.velocity, velocity);
    EXPECT_THAT(shared_memory_names(), IsEmpty());
}

/// A FluidState that the server must refuse.
void expect_fluid_refused(std::function<void(RawMessage&)> const& spoil, std::string const& part)
{
    RawSharedClient client;
    ASSERT_NO_FATAL_FAILURE(client.be_ready());
    RawMessage message = client.fluid(0);
    spoil(message);
    client.peer.send(message);
    EXPECT_THAT(client.peer.receive_error(), HasSubstr(part));
    std::string const thrown = client.end();
    EXPECT_THAT(thrown, testing::StartsWith("protocol: "));
    EXPECT_THAT(thrown, HasSubstr(part));
    EXPECT_THAT(shared_memory_names(), IsEmpty());
}

TEST(SharedMemoryRefuses, ADescriptorThatPointsOutside)
{
    std::uint64_t const last = (1 << 20) - velocity_bytes;
    for (std::uint64_t const offset : {last + 8, std::uint64_t{1} << 20, ~std::uint64_t{0} - 7})
        expect_fluid_refused([&](RawMessage& fluid) { fluid.envelope.mutable_arrays(0)->set_offset(offset); },
                             "lies out of bounds (the segment has 1048576 bytes)");
    expect_fluid_refused([&](RawMessage& fluid)
                         { fluid.envelope.mutable_arrays(0)->set_count(std::uint64_t{1} << 61); },
                         "its header promises 2305843009213693952 rows");
}

TEST(SharedMemoryRefuses, ADescriptorThatIsNotAligned)
{
    expect_fluid_refused([](RawMessage& fluid) { fluid.envelope.mutable_arrays(0)->set_offset(644); },
                         "is not aligned");
}

TEST(SharedMemoryRefuses, ASharedArrayWithBytesInItsFrame)
{
    expect_fluid_refused([](RawMessage& fluid) { fluid.arrays[0] = std::string(velocity_bytes, '\0'); },
                         "a truncated or padded frame");
}

TEST(SharedMemoryRefuses, ASharedArrayOfAClientThatAnnouncedNothing)
{
    RawSharedClient client;
    client.peer.send(raw_hello());
    auto const welcome = client.peer.receive();
    ASSERT_TRUE(welcome);
    client.peer.send(raw_mesh(mesh()));
    ASSERT_TRUE(client.peer.receive());
    ASSERT_TRUE(client.peer.receive());
    client.peer.send(client.fluid(0));
    EXPECT_THAT(client.peer.receive_error(), HasSubstr("lies in shared memory, but none of the sender is mapped"));
    client.end();
}

TEST(SharedMemoryRefuses, AMeshInSharedMemory)
{
    RawSharedClient client;
    ASSERT_TRUE(client.greet());
    RawMessage message = raw_mesh(mesh());
    message.envelope.mutable_arrays(0)->set_shared(true);
    message.arrays[0].clear();
    client.peer.send(message);
    EXPECT_THAT(client.peer.receive_error(), HasSubstr("only fields may lie there"));
    client.end();
}

TEST(SharedMemoryRefuses, AnAnnouncementThatCannotBeTrue)
{
    auto const refusal = [](std::string const& name, std::uint64_t bytes)
    {
        RawSharedClient client;
        EXPECT_TRUE(client.greet());
        auto const answer = client.announce(name.empty() ? client.own->notice().name : name, bytes);
        EXPECT_THAT(client.end(), testing::StartsWith("protocol: "));
        return answer ? answer->envelope.error().reason() : "(nothing came)";
    };
    EXPECT_THAT(refusal("/somebody-else", 1 << 20), HasSubstr("is none of ours"));
    EXPECT_THAT(refusal("", (1 << 20) + 1), HasSubstr("1048576 bytes instead of the 1048577"));
    EXPECT_THAT(refusal("", 0), HasSubstr("segment of 0 bytes"));
}

TEST(SharedMemoryFallback, OfASegmentThatThisMachineDoesNotHaveIsANoteAndPlainFrames)
{
    RawSharedClient client;
    ASSERT_TRUE(client.greet());
    auto const accepted = client.announce("/gimdem-1-" + std::string(32, '0'), 1 << 20);
    ASSERT_TRUE(accepted && accepted->envelope.has_mesh_accepted());
    EXPECT_FALSE(accepted->envelope.shared_memory().mapped());
    ASSERT_TRUE(client.peer.receive());
    client.peer.send(raw_fluid(1, 0, 0.5, static_cast<int>(cells), {{"velocity", 3}, {"pressure_gradient", 3}}));
    auto const solid = client.peer.receive();  // we did not confirm the server's segment either
    ASSERT_TRUE(solid && solid->envelope.has_solid_state());
    EXPECT_FALSE(solid->envelope.arrays(0).shared());
    EXPECT_EQ(solid->arrays.at(0).size(), cells * sizeof(double));
    client.peer.send(raw_goodbye());
    EXPECT_EQ(client.end(), "(nothing)");
    EXPECT_THAT(client.note, HasSubstr("cannot be opened"));
    EXPECT_THAT(client.note, HasSubstr("plain frames"));
    client.own.reset();
    EXPECT_THAT(shared_memory_names(), IsEmpty()) << "the server's too";
}

TEST(SharedMemoryFallback, IsNoMatterOverTcp)
{
    Server server(server_options(any_tcp_endpoint()));
    RawPeer peer = RawPeer::client(server.endpoint());
    auto served = in_background([&] { return thrown_by([&] { server.wait_for_client(server_terms()); }); });
    RawMessage hello = raw_hello();
    hello.envelope.mutable_shared_memory()->set_offered(true);
    peer.send(hello);
    auto const welcome = peer.receive();
    ASSERT_TRUE(welcome);
    EXPECT_FALSE(welcome->envelope.has_shared_memory());
    EXPECT_EQ(served.get(), "(nothing)");
}

}  // namespace
}  // namespace gimdem::test

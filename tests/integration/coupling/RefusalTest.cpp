// SPDX-License-Identifier: BSD-3-Clause
/// What the real server refuses, in words and with its exit code.
#include <gtest/gtest.h>

#include "RawMessages.hpp"
#include "ServerProcess.hpp"
#include "UniformFluid.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

int constexpr cells = 4 * 4 * 8;
std::vector<std::pair<std::string, unsigned>> const needs{
    {"velocity", 3}, {"velocity_gradient", 9}, {"void_fraction_gradient", 3}};

class Refusal : public testing::TestWithParam<char const*>
{
protected:
    Refusal() : server(endpoint_over(GetParam())) {}

    RawPeer raw_client() const { return RawPeer::client(server.endpoint()); }

    static void greet(RawPeer& peer)
    {
        peer.send(raw_hello());
        auto const welcome = peer.receive(soon);
        ASSERT_TRUE(welcome && welcome->envelope.has_welcome());
    }

    static void send_mesh(RawPeer& peer)
    {
        peer.send(raw_mesh(SmallCase::mesh()));
        ASSERT_TRUE(peer.receive(soon)) << "no MeshAccepted";
        auto const solid = peer.receive(soon);
        ASSERT_TRUE(solid && solid->envelope.has_solid_state());
    }

    /// The server tells both its client and its terminal, and ends with an exit code.
    void expect_refusal(RawPeer& peer, std::string const& part)
    {
        EXPECT_THAT(peer.receive_error(soon), testing::HasSubstr(part));
        server.expect_end(1, part);
    }

    ServerProcess server;
};

INSTANTIATE_TEST_SUITE_P(Over, Refusal, testing::Values("ipc", "tcp"),
                         [](auto const& transport) { return std::string(transport.param); });

TEST_P(Refusal, OfAWrongVersion)
{
    RawPeer peer = raw_client();
    RawMessage hello = raw_hello();
    hello.envelope.set_protocol_major(2);
    peer.send(hello);
    expect_refusal(peer, "the peer speaks protocol 2.0 and this side speaks 1.");
}

TEST_P(Refusal, OfAMessageOutOfOrder)
{
    RawPeer peer = raw_client();
    greet(peer);
    peer.send(raw_fluid(1, 0, 1e-4, cells, needs));
    expect_refusal(peer, "FluidState of step 1 from client \"raw client\" is out of order in state welcomed");
}

TEST_P(Refusal, OfAStepOutOfOrder)
{
    RawPeer peer = raw_client();
    greet(peer);
    send_mesh(peer);
    peer.send(raw_fluid(2, 0, 1e-4, cells, needs));
    expect_refusal(peer, "step 2 follows step 0");
}

TEST_P(Refusal, OfATruncatedFrame)
{
    RawPeer peer = raw_client();
    greet(peer);
    send_mesh(peer);
    RawMessage message = raw_fluid(1, 0, 1e-4, cells, needs);
    message.arrays[0].resize(1000);
    peer.send(message);
    expect_refusal(peer, "array \"velocity\" has 1000 bytes, but its header promises 128 rows of 24");
}

TEST_P(Refusal, OfATruncatedEnvelope)
{
    RawPeer peer = raw_client();
    RawMessage hello = raw_hello();
    hello.envelope.set_protocol_major(1);
    std::string const envelope = hello.frames().front();
    peer.send_frames({envelope.substr(0, envelope.size() - 3)});
    expect_refusal(peer, "cannot be read");
}

TEST_P(Refusal, OfAMeshWithANegativeVolume)
{
    Mesh mesh = SmallCase::mesh();
    for (std::size_t i = 0; i < mesh.points.size(); i += 3)
        mesh.points[i] = -mesh.points[i];  // mirrored: every face normal points the wrong way
    Client client(client_options(server.endpoint()));
    client.connect(air);
    try
    {
        client.send_mesh(view_of(mesh));
        FAIL() << "the mesh was accepted";
    }
    catch (CouplingError const& error)
    {
        EXPECT_EQ(error.fault(), Fault::mesh);
        EXPECT_THAT(error.what(), testing::HasSubstr("refused the mesh"));
        EXPECT_THAT(error.what(), testing::HasSubstr("volume"));
    }
    server.expect_end(1, "volume");
}

TEST_P(Refusal, OfAnEndpointInUse)
{
    std::string const endpoint = server.endpoint();
    ServerProcess second(endpoint);
    EXPECT_EQ(second.process().wait(soon), 1);
    EXPECT_THAT(second.process().output(), testing::HasSubstr("is in use"));

    // The first has not noticed.
    Client client(client_options(endpoint));
    client.connect(air);
    client.send_mesh(view_of(SmallCase::mesh()));
    client.finish("done");
    server.expect_end(0, "");
}

TEST_P(Refusal, OfASecondClient)
{
    Client first(client_options(server.endpoint()));
    first.connect(air);
    first.send_mesh(view_of(SmallCase::mesh()));
    Client second(client_options(server.endpoint()));
    try
    {
        second.connect(air);
        FAIL() << "the second client was welcomed";
    }
    catch (CouplingError const& error)
    {
        EXPECT_THAT(error.what(), testing::HasSubstr("is busy with client \"scripted client\""));
    }
    UniformFluid const fluid(cells, {0, 0, 1});
    first.begin_step({1, 0, 1e-4}, fluid.view());
    first.end_step();
    first.finish("done");
    server.expect_end(0, "");
}

TEST(RefusalAlone, OfAnAddressThatOthersCouldReach)
{
    ServerProcess server("tcp://0.0.0.0:5599");
    server.expect_end(1, "allowed without keys");
}

}  // namespace
}  // namespace gimdem::test

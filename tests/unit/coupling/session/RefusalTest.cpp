// SPDX-License-Identifier: BSD-3-Clause
/// What the public classes do when a raw peer breaks the rules, or their own program does.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "Faults.hpp"
#include "Pair.hpp"
#include "RawMessages.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

int const cells = small_mesh().cell_count;
std::vector<std::pair<std::string, unsigned>> const needs{{"velocity", 3}, {"pressure_gradient", 3}};

RawMessage fluid(int number, double time, double dt = 0.5)
{
    return raw_fluid(number, time, dt, cells, needs);
}

/// Serves a raw client; returns what ended the session.
std::string serve(Server& server)
{
    return thrown_by(
        [&]
        {
            server.wait_for_client(server_terms());
            server.receive_mesh();
            std::vector<double> const full(static_cast<std::size_t>(cells), 1.0);
            SolidFields solid;
            solid.void_fraction = full;
            server.accept_mesh(solid);
            while (server.receive_fluid())
                server.send_solid(solid, {});
        });
}

/// A raw client of a real server, in state ready.
class RawClient
{
public:
    RawClient() : server_(server_options(unused_ipc_endpoint())), peer(RawPeer::client(server_.endpoint()))
    {
        served_ = in_background([this] { return serve(server_); });
    }

    void greet()
    {
        peer.send(raw_hello());
        ASSERT_TRUE(peer.receive());
    }
    void be_ready()
    {
        greet();
        peer.send(raw_mesh(small_mesh()));
        ASSERT_TRUE(peer.receive());
        ASSERT_TRUE(peer.receive());
    }

    /// Both the server's own fault and the Error that it sent must have these parts.
    void expect_refusal(std::string const& fault, std::vector<std::string> const& parts)
    {
        std::string const told = peer.receive_error();
        std::string const thrown = served_.get();
        EXPECT_THAT(thrown, testing::StartsWith(fault + ": "));
        for (std::string const& part : parts)
        {
            EXPECT_THAT(thrown, testing::HasSubstr(part));
            EXPECT_THAT(told, testing::HasSubstr(part));
        }
    }

private:
    Server server_;
    std::future<std::string> served_;

public:
    RawPeer peer;
};

TEST(ServerRefuses, AClientOfAnotherVersion)
{
    RawClient client;
    RawMessage hello = raw_hello();
    hello.envelope.set_protocol_major(2);
    hello.envelope.set_protocol_minor(7);
    client.peer.send(hello);
    client.expect_refusal("version", {"the peer speaks protocol 2.7 and this side speaks 1.", "in state listening"});
}

TEST(ServerRefuses, RubbishInsteadOfHello)
{
    RawClient client;
    client.peer.send_frames({"GET / HTTP/1.1"});
    client.expect_refusal("protocol", {"cannot be read", "in state listening"});
}

TEST(ServerRefuses, AMeshBeforeHello)
{
    RawClient client;
    client.peer.send(raw_mesh(small_mesh()));
    client.expect_refusal("protocol", {"out of order in state listening", "allowed here: Hello"});
}

TEST(ServerRefuses, AMeshWithAWrongIndex)
{
    Mesh mesh = small_mesh();
    mesh.owner[3] = cells;
    RawClient client;
    client.greet();
    client.peer.send(raw_mesh(mesh));
    client.expect_refusal("protocol", {"Mesh: owner[3] names cell 24 (the mesh has 24)"});
}

TEST(ServerRefuses, ATruncatedFrame)
{
    RawClient client;
    client.be_ready();
    RawMessage message = fluid(1, 0);
    message.arrays[1].resize(100);
    client.peer.send(message);
    client.expect_refusal(
        "protocol",
        {"array \"pressure_gradient\" has 100 bytes, but its header promises 24 rows of 24", "in state ready"});
}

TEST(ServerRefuses, AWrongCount)
{
    RawClient client;
    client.be_ready();
    client.peer.send(raw_fluid(1, 0, 0.5, cells + 1, needs));
    client.expect_refusal("protocol", {"array \"velocity\" has 25 rows instead of 24"});
}

TEST(ServerRefuses, ANan)
{
    RawClient client;
    client.be_ready();
    RawMessage message = fluid(1, 0);
    double const nan = std::numeric_limits<double>::quiet_NaN();
    message.arrays[0].replace(3 * 8 * 5, 8, reinterpret_cast<char const*>(&nan), 8);
    client.peer.send(message);
    client.expect_refusal("protocol", {"field \"velocity\" has nan in cell 5"});
}

TEST(ServerRefuses, AStepThatIsOutOfOrder)
{
    struct Case
    {
        RawMessage second;
        std::string text;
    };
    for (auto const& [second, text] :
         {Case{fluid(3, 0.5), "step 3 follows step 1"}, Case{fluid(1, 0.5), "step 1 follows step 1"},
          Case{fluid(2, 0.6), "step 2 begins at 0.6 s"}, Case{fluid(2, 0.5, 0), "dt = 0 s"},
          Case{fluid(2, 0.5, -1), "dt = -1 s"}})
    {
        RawClient client;
        client.be_ready();
        client.peer.send(fluid(1, 0));
        ASSERT_TRUE(client.peer.receive());
        client.peer.send(second);
        client.expect_refusal("protocol", {"is out of order", text});
    }
}

TEST(ServerRefuses, AMeshInsteadOfAFluid)
{
    RawClient client;
    client.be_ready();
    client.peer.send(raw_mesh(small_mesh()));
    client.expect_refusal("protocol", {"Mesh from client \"raw client\" is out of order in state ready, step 0",
                                       "allowed here: FluidState or Checkpoint or Goodbye"});
}

/// A raw server that answers the Hello of a real client, its Mesh, and its first FluidState.
struct RawAnswers
{
    RawMessage welcome = raw_welcome();
    RawMessage mesh_accepted = raw_mesh_accepted(cells);
    RawMessage solid_at_zero = raw_solid(0, cells);
    RawMessage solid = raw_solid(1, cells);
};

struct Outcome
{
    std::string thrown;  ///< by the client
    std::string told;    ///< to the server: the reason of the client's Error
};

Outcome run_client(RawAnswers const& answers)
{
    RawPeer peer = RawPeer::server(unused_ipc_endpoint());
    auto told = in_background(
        [&]
        {
            auto const answer = [&](std::vector<RawMessage> const& messages)
            {
                auto const received = peer.receive();
                if (!received || received->envelope.has_error() || received->envelope.has_goodbye()) return received;
                for (RawMessage const& message : messages)
                    peer.send(message);
                return std::optional<RawMessage>();
            };
            auto last = answer({answers.welcome});
            peer.set_session(77);
            if (!last) last = answer({answers.mesh_accepted, answers.solid_at_zero});
            if (!last) last = answer({answers.solid});
            if (!last) last = peer.receive();
            return last && last->envelope.has_error() ? last->envelope.error().reason() : "(no error)";
        });
    Outcome outcome;
    {
        Client client(client_options(peer.endpoint()));
        outcome.thrown = thrown_by(
            [&]
            {
                client.connect({1.2, 1.8e-5});
                client.send_mesh(view_of(small_mesh()));
                client.begin_step(step(1), FluidArrays(static_cast<std::size_t>(cells), 1).view());
                client.end_step();
                client.finish("done");
            });
    }
    outcome.told = told.get();
    return outcome;
}

TEST(ClientRefuses, NothingOfAGoodServer)
{
    Outcome const outcome = run_client({});
    EXPECT_EQ(outcome.thrown, "(nothing)");
    EXPECT_EQ(outcome.told, "(no error)");
}

TEST(ClientRefuses, WhatABadServerSends)
{
    struct Case
    {
        std::string name;
        std::function<void(RawAnswers&)> damage;
        std::string fault;
        std::string text;
    };
    double const infinity = std::numeric_limits<double>::infinity();
    std::vector<Case> const cases{
        {"version", [](auto& a) { a.welcome.envelope.set_protocol_major(3); }, "version", "protocol 3.0"},
        {"no schedule", [](auto& a) { a.welcome.envelope.mutable_welcome()->clear_schedule(); }, "protocol",
         "no schedule"},
        {"solid instead of welcome", [](auto& a) { a.welcome = raw_solid(0, cells); }, "protocol", "in state greeting"},
        {"other cells", [](auto& a) { a.mesh_accepted = raw_mesh_accepted(7); }, "protocol", "7 cells instead of 24"},
        {"other session", [](auto& a) { a.mesh_accepted.envelope.set_session(5); }, "protocol", "belongs to session 5"},
        {"no acceptance", [](auto& a) { a.mesh_accepted = raw_solid(0, cells); }, "protocol",
         "allowed here: MeshAccepted"},
        {"other size", [](auto& a) { a.solid_at_zero = raw_solid(0, cells + 2); }, "protocol", "26 rows instead of 24"},
        {"other step", [](auto& a) { a.solid = raw_solid(2, cells); }, "protocol", "it should answer step 1"},
        {"truncated", [](auto& a) { a.solid.arrays[2].resize(8); }, "protocol", "\"drag_momentum\" has 8 bytes"},
        {"infinite", [&](auto& a) { a.solid.arrays[1].replace(0, 8, reinterpret_cast<char const*>(&infinity), 8); },
         "protocol", "\"drag_coefficient\" has inf in cell 0"},
        {"goodbye", [](auto& a) { a.solid = raw_goodbye(); }, "protocol", "Goodbye from server \"raw server\""}};
    for (Case const& damaged : cases)
    {
        SCOPED_TRACE(damaged.name);
        RawAnswers answers;
        damaged.damage(answers);
        Outcome const outcome = run_client(answers);
        EXPECT_THAT(outcome.thrown, testing::StartsWith(damaged.fault + ": "));
        EXPECT_THAT(outcome.thrown, testing::HasSubstr(damaged.text));
        EXPECT_THAT(outcome.told, testing::HasSubstr(damaged.text));
    }
}

TEST(Calls, InTheWrongOrderAreRefusedAndChangeNothing)
{
    Server server(server_options(unused_ipc_endpoint()));
    EXPECT_FAULT(server.receive_mesh(), Fault::user, "receive_mesh() is illegal in state listening");
    EXPECT_FAULT(server.receive_fluid(), Fault::user, "receive_fluid() is illegal in state listening");
    auto served = in_background([&] { return serve(server); });

    Client client(client_options(server.endpoint()));
    auto const fields = FluidArrays(static_cast<std::size_t>(cells), 1);
    EXPECT_FAULT(client.send_mesh(view_of(small_mesh())), Fault::user, "send_mesh() is illegal in state created");
    client.connect({1.2, 1.8e-5});
    EXPECT_FAULT(client.begin_step(step(1), fields.view()), Fault::user, "begin_step() is illegal in state welcomed");
    EXPECT_FAULT(client.connect({1.2, 1.8e-5}), Fault::user, "connect() is illegal in state welcomed");
    client.abort("that will do");
    EXPECT_THAT(served.get(), testing::HasSubstr("that will do"));
}

TEST(Options, ThatMakeNoSenseAreRefused)
{
    auto const client = [](auto change)
    {
        return [change]
        {
            ClientOptions options = client_options("ipc:///tmp/unused");
            change(options);
            Client{options};
        };
    };
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FAULT(client([](auto& o) { o.name.clear(); })(), Fault::user, "ClientOptions.name is empty");
    EXPECT_FAULT(client([](auto& o) { o.timeout = 0; })(), Fault::user, "ClientOptions.timeout is 0");
    EXPECT_FAULT(client([&](auto& o) { o.step_time = nan; })(), Fault::user, "ClientOptions.step_time is nan");
    EXPECT_FAULT(client([](auto& o) { o.connect_time = -1; })(), Fault::user, "ClientOptions.connect_time is -1");
    EXPECT_FAULT(client([](auto& o) { o.wants = {"void_fracton"}; })(), Fault::user,
                 "unknown solid field \"void_fracton\"");

    ServerOptions options = server_options(unused_ipc_endpoint());
    options.timeout = nan;
    EXPECT_FAULT(Server{options}, Fault::user, "ServerOptions.timeout is nan");
    ServerTerms terms = server_terms();
    terms.needs = {"velocity", "velocity"};
    Server server(server_options(unused_ipc_endpoint()));
    EXPECT_FAULT(server.wait_for_client(terms), Fault::user, "\"velocity\" is asked for twice");
}

}  // namespace
}  // namespace gimdem::test

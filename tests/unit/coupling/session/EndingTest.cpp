// SPDX-License-Identifier: BSD-3-Clause
/// How sessions end before their time: each side must know, soon, and be able to say why.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "Faults.hpp"
#include "Pair.hpp"
#include "RawMessages.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

double constexpr impatient = 0.5;  ///< time-out of the tests that wait for one [s]
double constexpr at_once =
    2;  ///< below a fifth of `patient`, where a heartbeat would tell; above what a busy machine needs [s]

class Stopwatch
{
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::size_t cell_count(Mesh const& mesh)
{
    return static_cast<std::size_t>(mesh.cell_count);
}

/// Serves until the end; returns what ended it.
std::string serve(Server& server, Schedule schedule = Schedule::serial)
{
    return thrown_by(
        [&]
        {
            server.wait_for_client(server_terms(schedule));
            auto const cells = cell_count(server.receive_mesh());
            server.accept_mesh(SolidArrays(cells, 0).view());
            while (auto fluid = server.receive_fluid())
                server.send_solid(SolidArrays(cells, static_cast<double>(fluid->step.number)).view(), {});
        });
}

/// Connects and sends the mesh.
void start(Client& client)
{
    client.connect({1.2, 1.8e-5});
    client.send_mesh(view_of(small_mesh()));
}

void run_step(Client& client, int n)
{
    client.begin_step(step(n), FluidArrays(cell_count(small_mesh()), n).view());
    client.end_step();
}

/// The client's half of a session with a raw server, up to `ready`.
void welcome_client(RawPeer& server)
{
    ASSERT_TRUE(server.receive()) << "no Hello";
    server.send(raw_welcome());
    server.set_session(77);
    ASSERT_TRUE(server.receive()) << "no Mesh";
    server.send(raw_mesh_accepted(small_mesh().cell_count));
    server.send(raw_solid(0, small_mesh().cell_count));
}

TEST(Ending, ClientThatAbortsTellsItsReason)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server); });
    Client client(client_options(server.endpoint()));
    start(client);
    run_step(client, 1);
    client.abort("the pressure solver diverged");

    std::string const seen = served.get();
    EXPECT_THAT(seen,
                testing::StartsWith("peer: client \"test client 1\" ended the run: the pressure solver diverged"));
    EXPECT_THAT(seen, testing::HasSubstr("server \"test server 1\" was waiting for FluidState in state ready, step 1"));
    EXPECT_FAULT(run_step(client, 2), Fault::user, "after the fault: the pressure solver diverged");
}

TEST(Ending, ClientThatIsDestroyedTellsItsLastFault)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server); });
    {
        Client client(client_options(server.endpoint()));
        start(client);
        EXPECT_FAULT(client.begin_step(step(1), FluidFields()), Fault::user, "\"velocity\" has 0 numbers");
    }
    EXPECT_THAT(served.get(), testing::HasSubstr("ended the run: field \"velocity\" has 0 numbers"));
}

TEST(Ending, ServerThatAbortsTellsItsReason)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background(
        [&]
        {
            server.wait_for_client(server_terms());
            auto const cells = cell_count(server.receive_mesh());
            server.accept_mesh(SolidArrays(cells, 0).view());
            server.receive_fluid();
            server.abort("particle 812 has left the mesh");
        });
    Client client(client_options(server.endpoint()));
    start(client);

    std::string const seen = thrown_by([&] { run_step(client, 1); });
    EXPECT_THAT(seen,
                testing::StartsWith("peer: server \"test server 1\" ended the run: particle 812 has left the mesh"));
    EXPECT_THAT(seen, testing::HasSubstr("it was in state computing, step 1"));
    EXPECT_THAT(seen, testing::HasSubstr("waiting for SolidState of step 1 in state waiting"));
    served.get();
}

TEST(Ending, RejectedMeshIsTheClientsMeshFault)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background(
        [&]
        {
            server.wait_for_client(server_terms());
            server.receive_mesh();
            server.reject_mesh("cell 7 has a volume of -1 mm3");
        });
    Client client(client_options(server.endpoint()));
    EXPECT_FAULT(start(client), Fault::mesh, "refused the mesh: cell 7 has a volume of -1 mm3");
    served.get();
}

TEST(Ending, GoodbyeBeforeTheMeshIsNotTheServersFault)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server); });
    Client client(client_options(server.endpoint()));
    client.connect({1.2, 1.8e-5});
    client.finish("only asked");
    EXPECT_THAT(served.get(), testing::HasSubstr("said goodbye before it sent its mesh: only asked"));
}

TEST(Ending, FinishWithinAnOverlappedStepIsOrderly)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server, Schedule::overlapped); });
    Client client(client_options(server.endpoint()));
    start(client);
    client.begin_step(step(1), FluidArrays(cell_count(small_mesh()), 1).view());
    client.finish("stopped within a step");
    EXPECT_EQ(served.get(), "(nothing)");
    EXPECT_EQ(server.goodbye_reason(), "stopped within a step");
    EXPECT_FALSE(server.receive_fluid()) << "the end stays the end";
}

TEST(Ending, StopRequestTravelsWithTheNextSolid)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server); });
    Client client(client_options(server.endpoint()));
    start(client);
    run_step(client, 1);
    EXPECT_FALSE(client.stop_request());
    server.request_stop("Ctrl-C");
    run_step(client, 2);
    EXPECT_EQ(client.stop_request(), "Ctrl-C");
    client.finish("as asked");
    EXPECT_EQ(served.get(), "(nothing)");
}

TEST(Ending, ClientThatVanishesIsNoticedAtOnce)
{
    for (std::string const& endpoint : {unused_ipc_endpoint(), any_tcp_endpoint()})
    {
        Server server(server_options(endpoint));
        auto served = in_background([&] { return serve(server); });
        Stopwatch stopwatch;
        {
            RawPeer client = RawPeer::client(server.endpoint());
            client.send(raw_hello());
            ASSERT_TRUE(client.receive());
            stopwatch = Stopwatch();
        }
        std::string const seen = served.get();
        EXPECT_LT(stopwatch.seconds(), at_once);
        EXPECT_THAT(seen,
                    testing::StartsWith("peer: client \"raw client\" at " + server.endpoint() + " has disappeared"));
        EXPECT_THAT(seen, testing::HasSubstr("waiting for Mesh in state welcomed"));
    }
}

TEST(Ending, ServerThatVanishesIsNoticedAtOnce)
{
    for (std::string const& endpoint : {unused_ipc_endpoint(), any_tcp_endpoint()})
    {
        auto server = std::make_unique<RawPeer>(RawPeer::server(endpoint));
        Client client(client_options(server->endpoint()));
        auto greeted = in_background([&] { welcome_client(*server); });
        start(client);
        greeted.get();

        Stopwatch const stopwatch;
        server.reset();
        std::string const seen = thrown_by([&] { run_step(client, 1); });
        EXPECT_LT(stopwatch.seconds(), at_once);
        EXPECT_THAT(seen, testing::StartsWith("peer: server \"raw server\" at"));
        EXPECT_THAT(seen, testing::HasSubstr("has disappeared"));
    }
}

TEST(Ending, AServerOfAnotherVersionIsNoPeerThatFailed)
{
    RawPeer server = RawPeer::server(unused_ipc_endpoint());
    auto told = in_background(
        [&]
        {
            server.receive();
            RawMessage error = raw_error("this client is too old");
            error.envelope.mutable_error()->set_fault(v1::FAULT_KIND_VERSION);
            server.send(error);
        });
    Client client(client_options(server.endpoint()));
    EXPECT_THAT(thrown_by(
                    [&] {
                        client.connect({1.2, 1.8e-5});
                    }),
                testing::AllOf(testing::StartsWith("version: "), testing::HasSubstr("this client is too old")));
    told.get();
}

TEST(Ending, SilentClientTimesOut)
{
    Server server(server_options(unused_ipc_endpoint(), impatient));
    auto served = in_background([&] { return serve(server); });
    RawPeer client = RawPeer::client(server.endpoint());
    Stopwatch const stopwatch;
    client.send(raw_hello());
    ASSERT_TRUE(client.receive());

    std::string const seen = served.get();
    EXPECT_GT(stopwatch.seconds(), impatient);
    EXPECT_LT(stopwatch.seconds(), impatient + at_once);
    EXPECT_THAT(seen, testing::StartsWith("timeout: client \"raw client\""));
    EXPECT_THAT(seen, testing::HasSubstr("(time-out 0.5 s"));
    EXPECT_THAT(seen, testing::HasSubstr("waiting for Mesh in state welcomed"));
    EXPECT_THAT(client.receive_error(), testing::HasSubstr("has been silent for")) << "it hears of it when it wakes up";
}

TEST(Ending, SilentServerTimesOut)
{
    RawPeer server = RawPeer::server(unused_ipc_endpoint());
    Client client(client_options(server.endpoint(), impatient));
    auto greeted = in_background([&] { welcome_client(server); });
    start(client);
    greeted.get();

    Stopwatch const stopwatch;
    std::string const seen = thrown_by([&] { run_step(client, 1); });
    EXPECT_LT(stopwatch.seconds(), impatient + at_once);
    EXPECT_THAT(seen, testing::StartsWith("timeout: server \"raw server\""));
    EXPECT_THAT(seen, testing::HasSubstr("waiting for SolidState of step 1 in state waiting"));
}

TEST(Ending, BusyServerIsNotSilent)
{
    ServerOptions options = server_options(unused_ipc_endpoint());
    Server server(options);
    auto served = in_background(
        [&]
        {
            std::this_thread::sleep_for(std::chrono::duration<double>(3 * impatient));
            return serve(server);
        });
    Client client(client_options(server.endpoint(), impatient));
    EXPECT_NO_THROW(start(client));
    EXPECT_NO_THROW(run_step(client, 1));
    client.finish("done");
    EXPECT_EQ(served.get(), "(nothing)");
}

TEST(Ending, LiveServerThatNeverAnswersIsLeft)
{
    Server server(server_options(unused_ipc_endpoint()));
    ClientOptions options = client_options(server.endpoint());
    options.step_time = impatient;
    Client client(options);
    std::string const seen = thrown_by([&] { client.connect({1.2, 1.8e-5}); });
    EXPECT_THAT(seen, testing::StartsWith("timeout: server \"test server 1\""));
    EXPECT_THAT(seen, testing::HasSubstr("has not sent Welcome within 0.5 s"));
    EXPECT_THAT(seen, testing::HasSubstr("state listening"));
}

TEST(Ending, NoServerIsAnEndpointFault)
{
    for (std::string const& endpoint : {unused_ipc_endpoint(), std::string("tcp://127.0.0.1:9")})
    {
        ClientOptions options = client_options(endpoint);
        options.connect_time = 0.2;
        Client client(options);
        EXPECT_FAULT(client.connect({1.2, 1.8e-5}), Fault::endpoint, "no server has answered at " + endpoint);
    }
}

TEST(Ending, NoClientIsATimeout)
{
    ServerOptions options = server_options(unused_ipc_endpoint());
    options.connect_time = 0.2;
    Server server(options);
    EXPECT_FAULT(server.wait_for_client(server_terms()), Fault::timeout, "no client has appeared at ipc:///");
}

TEST(Ending, SecondClientIsSentAwayAndTheFirstGoesOn)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server); });
    Client first(client_options(server.endpoint()));
    start(first);

    ClientOptions options = client_options(server.endpoint());
    options.name = "second";
    Client second(options);
    EXPECT_FAULT(second.connect({1, 1}), Fault::peer, "is busy with client \"test client 1\"");
    RawPeer third = RawPeer::client(server.endpoint());
    third.send_frames({"rubbish"});
    EXPECT_THAT(third.receive_error(), testing::HasSubstr("cannot be read"));

    for (int n = 1; n <= 3; ++n)
        run_step(first, n);
    first.finish("done");
    EXPECT_EQ(served.get(), "(nothing)");
}

TEST(Ending, EndpointInUseIsRefusedAndStaysInUse)
{
    for (std::string const& endpoint : {unused_ipc_endpoint(), any_tcp_endpoint()})
    {
        Server first(server_options(endpoint));
        EXPECT_FAULT(Server(server_options(first.endpoint())), Fault::endpoint, "is in use");

        auto served = in_background([&] { return serve(first); });
        Client client(client_options(first.endpoint()));
        EXPECT_NO_THROW(start(client)) << "the live server must not notice";
        client.finish("done");
        EXPECT_EQ(served.get(), "(nothing)");
    }
}

TEST(Ending, NextServerUsesTheSameEndpoint)
{
    auto const endpoint = unused_ipc_endpoint();
    for (int run = 0; run < 3; ++run)
    {
        Server server(server_options(endpoint));
        auto served = in_background([&] { return serve(server); });
        Client client(client_options(endpoint));
        start(client);
        client.finish("done");
        EXPECT_EQ(served.get(), "(nothing)");
    }
    EXPECT_FALSE(std::filesystem::exists(file_of(endpoint)));
    EXPECT_FALSE(std::filesystem::exists(file_of(endpoint) + ".lock"));
}

TEST(Ending, ServerThatComesLateIsFound)
{
    auto const endpoint = unused_ipc_endpoint();
    auto connected = in_background(
        [&]
        {
            Client client(client_options(endpoint));
            start(client);
            client.finish("done");
        });
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    Server server(server_options(endpoint));
    EXPECT_EQ(serve(server), "(nothing)");
    connected.get();
}

}  // namespace
}  // namespace gimdem::test

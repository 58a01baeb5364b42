// SPDX-License-Identifier: BSD-3-Clause
/// Questions to a server: answered in every state, by whoever asks, and without any effect on the run.
#include "gimdem/coupling/Status.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "Faults.hpp"
#include "KeyFolder.hpp"
#include "Pair.hpp"
#include "RawMessages.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;
using namespace std::chrono_literals;

RawMessage raw_question()
{
    RawMessage message;
    message.envelope.mutable_status_request()->set_name("a test");
    return message;
}

RunStatus a_run()
{
    RunStatus run;
    run.title = "a test";
    run.activity = "testing";
    run.time = 0.25;
    run.end_time = 1;
    run.wall_per_simulated = 8;
    run.figures = {{"particles", 300, "1"}, {"courant_max", not_known, "1"}};
    return run;
}

class StatusOf : public testing::TestWithParam<std::string>
{
protected:
    StatusOf() : server_(server_options(GetParam() == "ipc" ? unused_ipc_endpoint() : any_tcp_endpoint())) {}

    Status ask() const { return query_status(server_.endpoint(), patient); }

    Server server_;
};

TEST_P(StatusOf, EveryState)
{
    server_.publish(a_run());
    Status const first = ask();
    EXPECT_EQ(first.server, "test server 1");
    EXPECT_EQ(first.protocol, "1.1");
    EXPECT_EQ(first.state, "listening");
    EXPECT_EQ(first.client, "");
    EXPECT_EQ(first.process, ::getpid());
    EXPECT_GT(first.memory, 1e6) << "a process has a megabyte at least";
    EXPECT_LT(first.memory, 1e11);
    EXPECT_EQ(first.run.activity, "testing");
    EXPECT_EQ(first.run.time_left(), 6);
    ASSERT_EQ(first.run.figures.size(), 2u);
    EXPECT_EQ(first.run.figures[0].name, "particles");
    EXPECT_EQ(first.run.figures[0].value, 300);
    EXPECT_TRUE(std::isnan(first.run.figures[1].value));

    // The asker has not become the client.
    Client client(client_options(server_.endpoint()));
    auto connected = in_background([&] { client.connect({1.2, 1.8e-5}); });
    server_.wait_for_client(server_terms());
    connected.get();
    EXPECT_EQ(ask().state, "welcomed");
    EXPECT_EQ(ask().client, "test client 1");
    auto meshed = in_background([&] { client.send_mesh(view_of(small_mesh())); });
    server_.receive_mesh();
    EXPECT_EQ(ask().state, "meshing");
    server_.accept_mesh(SolidArrays(24, 0).view());
    meshed.get();
    EXPECT_EQ(ask().state, "ready");

    auto stepped = in_background([&] { client.begin_step(step(1), FluidArrays(24, 1).view()); });
    ASSERT_TRUE(server_.receive_fluid());
    std::this_thread::sleep_for(30ms);
    Status const computing = ask();
    EXPECT_EQ(computing.state, "computing");
    EXPECT_EQ(computing.step, 1);
    EXPECT_GE(computing.state_time, 0.03) << "since the step is computed";
    EXPECT_LT(computing.client_silence, patient);
    server_.send_solid(SolidArrays(24, 1).view(), {});
    stepped.get();
    EXPECT_EQ(ask().state, "ready");
    client.end_step();
    client.finish("done");
    EXPECT_FALSE(server_.receive_fluid());
    EXPECT_EQ(ask().state, "finished");
}

INSTANTIATE_TEST_SUITE_P(Transports, StatusOf, testing::Values("ipc", "tcp"));

TEST(StatusRequest, OfTheClientItselfIsAnsweredToo)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { server.wait_for_client(server_terms()); });
    RawPeer client = RawPeer::client(server.endpoint());
    client.send(raw_hello());
    ASSERT_TRUE(client.receive()->envelope.has_welcome());
    served.get();
    client.send(raw_question());
    auto const answer = client.receive();
    ASSERT_TRUE(answer && answer->envelope.has_status());
    EXPECT_EQ(answer->envelope.status().state(), "welcomed");
    EXPECT_EQ(answer->envelope.status().client(), "raw client");
}

TEST(StatusRequest, InAFloodChangesNothingForTheRun)
{
    int constexpr questions = 5000, steps = 50;
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background(
        [&]
        {
            server.wait_for_client(server_terms());
            auto const cells = static_cast<std::size_t>(server.receive_mesh().cell_count);
            server.accept_mesh(SolidArrays(cells, 0).view());
            while (server.receive_fluid())
                server.send_solid(SolidArrays(cells, 1).view(), {});
            return server.goodbye_reason();
        });
    Client client(client_options(server.endpoint()));
    client.connect({1.2, 1.8e-5});
    client.send_mesh(view_of(small_mesh()));
    RawPeer asker = RawPeer::client(server.endpoint());
    double const start = clock_now();
    for (int n = 0; n < questions; ++n)
        asker.send(raw_question());
    for (int n = 1; n <= steps; ++n)
    {
        client.begin_step(step(n), FluidArrays(24, n).view());
        client.end_step();
    }
    client.finish("done");
    EXPECT_EQ(served.get(), "done");

    int answers = 0;
    while (auto const answer = asker.receive(0.3))
        answers += answer->envelope.has_status();
    EXPECT_GE(answers, 1);
    EXPECT_LE(answers, 20 * (1 + clock_now() - start) + 1) << "20 a second, and as many at once";
}

TEST(StatusRequest, ThatIsLongerThanItNeedsIsNone)
{
    Server server(server_options(unused_ipc_endpoint()));
    RawPeer asker = RawPeer::client(server.endpoint());
    RawMessage question = raw_question();
    question.envelope.mutable_status_request()->set_name(std::string(2000, 'x'));
    asker.send(question);
    asker.send(raw_question());
    ASSERT_TRUE(asker.receive());
    EXPECT_FALSE(asker.receive(0.3)) << "the second alone has an answer";
}

TEST(StatusRequest, OfAnotherVersionIsRefusedInWords)
{
    Server server(server_options(unused_ipc_endpoint()));
    RawPeer asker = RawPeer::client(server.endpoint());
    RawMessage question = raw_question();
    question.envelope.set_protocol_major(2);
    asker.send(question);
    EXPECT_THAT(asker.receive_error(), testing::HasSubstr("the peer speaks protocol 2.0"));
    EXPECT_EQ(query_status(server.endpoint(), patient).state, "listening") << "it was no client's first message";
}

TEST(StatusQuery, TellsWhenNobodyListens)
{
    EXPECT_FAULT(query_status(unused_ipc_endpoint(), patient), Fault::endpoint, "nobody listens at ipc://");
    std::string closed;
    {
        Server const server(server_options(any_tcp_endpoint()));
        closed = server.endpoint();
    }
    EXPECT_FAULT(query_status(closed, patient), Fault::endpoint, "nobody listens at tcp://");
    EXPECT_FAULT(query_status("tcp://192.0.2.1:5570", patient), Fault::endpoint, "192.0.2.1");
}

/// A plain tcp listener: not ZeroMQ.
class Listener
{
public:
    Listener() : descriptor_(::socket(AF_INET, SOCK_STREAM, 0))
    {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof(address);
        ::bind(descriptor_, reinterpret_cast<sockaddr*>(&address), size);
        ::listen(descriptor_, 5);
        ::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size);
        endpoint_ = "tcp://127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    }
    ~Listener() { ::close(descriptor_); }
    Listener(Listener const&) = delete;
    Listener& operator=(Listener const&) = delete;

    std::string const& endpoint() const { return endpoint_; }
    void hang_up() const { ::close(::accept(descriptor_, nullptr, nullptr)); }

private:
    int descriptor_;
    std::string endpoint_;
};

TEST(StatusQuery, TellsWhoIsNoServer)
{
    Listener const silent;
    EXPECT_FAULT(query_status(silent.endpoint(), 0.2), Fault::timeout, "has not greeted within 0.2 s");
    Listener const other;
    auto hung_up = in_background([&] { other.hang_up(); });
    EXPECT_FAULT(query_status(other.endpoint(), patient), Fault::protocol, "does not speak ZeroMQ");
    hung_up.get();
}

TEST(StatusQuery, OpensAServerWithKeysByTheKeysOfItsClient)
{
    KeyFolder const ours, others;
    ServerOptions options = server_options(unused_ipc_endpoint());
    options.keys = ours.path();
    Server const server(options);
    EXPECT_EQ(query_status(server.endpoint(), patient, ours.path()).state, "listening");
    // Either may be first: what ZeroMQ says of the mechanisms, or that the server hangs up.
    EXPECT_THAT(thrown_by([&] { static_cast<void>(query_status(server.endpoint(), patient)); }),
                testing::AnyOf(testing::HasSubstr("does not let us in"), testing::HasSubstr("for want of keys")));
    // ZeroMQ tells a client that trusts another server nothing: the handshake does not come to an end.
    EXPECT_THAT(thrown_by([&] { query_status(server.endpoint(), 1, others.path()); }),
                testing::Not(testing::HasSubstr("(nothing)")));
}

TEST(StatusQuery, TellsOfServersOfOtherVersions)
{
    RawPeer old = RawPeer::server(unused_ipc_endpoint());
    EXPECT_FAULT(query_status(old.endpoint(), 0.2), Fault::timeout, "speaks protocol 1.0, which has no answer");

    RawPeer future = RawPeer::server(unused_ipc_endpoint());
    auto answered = in_background(
        [&]
        {
            future.receive();
            RawMessage error = raw_error("too old");
            error.envelope.set_protocol_major(2);
            future.send(error);
        });
    EXPECT_FAULT(query_status(future.endpoint(), patient), Fault::version, "the peer speaks protocol 2.0");
    answered.get();
}

TEST(StatusQuery, RefusesAnAnswerThatIsNone)
{
    RawPeer server = RawPeer::server(unused_ipc_endpoint());
    auto answered = in_background(
        [&]
        {
            server.receive();
            server.send(raw_goodbye());
        });
    EXPECT_FAULT(query_status(server.endpoint(), patient), Fault::protocol, "it answered with Goodbye");
    answered.get();
}

}  // namespace
}  // namespace gimdem::test

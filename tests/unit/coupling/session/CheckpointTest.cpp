// SPDX-License-Identifier: BSD-3-Clause
/// Checkpoints that a client asks for, and clients that go on from one.
#include <gtest/gtest.h>

#include <stdexcept>

#include "Faults.hpp"
#include "Pair.hpp"
#include "RawMessages.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

std::size_t const cells = static_cast<std::size_t>(small_mesh().cell_count);

/// Serves whole sessions; saves by `saver`, if there is one. Tells what ended the session, and what it saw.
struct Served
{
    std::optional<ResumePoint> resume;
    std::vector<CheckpointRequest> requests;
    std::vector<std::int64_t> steps_before;  ///< last step answered before each request
    std::string fault;
};

Served serve(Server& server, Schedule schedule, bool has_saver, std::string const& obstacle = "")
{
    Served seen;
    std::int64_t step = 0;
    if (has_saver)
        server.save_checkpoints_by(
            [&](CheckpointRequest const& request) -> SavedCheckpoint
            {
                if (!obstacle.empty()) throw std::runtime_error(obstacle);
                seen.requests.push_back(request);
                seen.steps_before.push_back(step);
                return {.session = 1, .step = 100 + step, .time = request.time, .name = "file.h5"};
            });
    try
    {
        seen.resume = server.wait_for_client(server_terms(schedule)).resume;
        server.receive_mesh();
        server.accept_mesh(SolidArrays(cells, 0).view());
        while (auto const fluid = server.receive_fluid())
        {
            step = fluid->step.number;
            server.send_solid(SolidArrays(cells, static_cast<double>(step)).view(), {});
        }
    }
    catch (std::exception const& error)
    {
        seen.fault = error.what();
        server.abort(error.what());
    }
    return seen;
}

class Checkpoints : public testing::TestWithParam<Schedule>
{
protected:
    /// A client with its mesh accepted, and its server.
    Checkpoints() : server(server_options(unused_ipc_endpoint())) {}

    Client client_of(bool has_saver, std::string const& obstacle = "", std::optional<ResumePoint> resume = {})
    {
        served = in_background([=, this] { return serve(server, GetParam(), has_saver, obstacle); });
        ClientOptions options = client_options(server.endpoint());
        options.resume = resume;
        Client client(std::move(options));
        client.connect({1.2, 1.8e-5});
        client.send_mesh(view_of(small_mesh()));
        return client;
    }

    static void run_step(Client& client, int n)
    {
        FluidArrays const fluid(cells, n);
        client.begin_step(step(n), fluid.view());
        client.end_step();
    }

    Server server;
    std::future<Served> served;
};

INSTANTIATE_TEST_SUITE_P(Schedules, Checkpoints, testing::Values(Schedule::serial, Schedule::overlapped),
                         [](auto const& schedule)
                         { return schedule.param == Schedule::serial ? "serial" : "overlapped"; });

TEST_P(Checkpoints, AreOfTheEndOfTheLastStep)
{
    Client client = client_of(true);
    EXPECT_TRUE(client.welcome().saves_checkpoints);
    run_step(client, 1);
    run_step(client, 2);
    SavedCheckpoint const first = client.save_checkpoint(0.002, 0);
    run_step(client, 3);
    SavedCheckpoint const second = client.save_checkpoint(0.003, first.step);
    client.finish("done");

    Served const seen = served.get();
    std::uint64_t const session = server.session_number();
    EXPECT_EQ(seen.fault, "");
    EXPECT_FALSE(seen.resume);
    EXPECT_EQ(seen.steps_before, (std::vector<std::int64_t>{2, 3}));
    ASSERT_EQ(seen.requests.size(), 2u);
    EXPECT_EQ(seen.requests[0].time, 0.002);
    EXPECT_EQ(seen.requests[0].complete_step, 0);
    EXPECT_EQ(seen.requests[1].complete_step, 102);
    EXPECT_EQ(first.session, session) << "the session of the wire, not what the program said";
    EXPECT_EQ(second.step, 103);
    EXPECT_EQ(second.time, 0.003);
    EXPECT_EQ(second.name, "file.h5");
}

TEST_P(Checkpoints, AreRefusedWithinAStep)
{
    Client client = client_of(true);
    FluidArrays const fluid(cells, 1);
    client.begin_step(step(1), fluid.view());
    EXPECT_FAULT(client.save_checkpoint(0.001, 0), Fault::user, "save_checkpoint() is illegal in state");
    client.end_step();
    client.save_checkpoint(0.001, 0);  // nothing was spoilt
    client.finish("done");
    EXPECT_EQ(served.get().requests.size(), 1u);
}

TEST_P(Checkpoints, AreNotAskedOfAServerThatSavesNone)
{
    Client client = client_of(false);
    EXPECT_FALSE(client.welcome().saves_checkpoints);
    EXPECT_FAULT(client.save_checkpoint(0, 0), Fault::user, "saves no checkpoints when asked");
    run_step(client, 1);
    client.finish("done");
    EXPECT_EQ(served.get().fault, "");
}

TEST_P(Checkpoints, ThatCannotBeSavedEndTheSessionWithTheReason)
{
    Client client = client_of(true, "cannot write file.h5 (No space left on device)");
    run_step(client, 1);
    EXPECT_FAULT(client.save_checkpoint(0.001, 0), Fault::peer, "No space left on device");
    EXPECT_EQ(served.get().fault, "cannot write file.h5 (No space left on device)");
}

TEST_P(Checkpoints, NameWhereAClientGoesOn)
{
    Client client = client_of(true, "", ResumePoint{0xfedcba9876543210, 42, 0.1 + 0.2});
    client.finish("done");
    Served const seen = served.get();
    ASSERT_TRUE(seen.resume);
    EXPECT_EQ(seen.resume->session, 0xfedcba9876543210u);
    EXPECT_EQ(seen.resume->step, 42);
    EXPECT_EQ(seen.resume->time, 0.1 + 0.2) << "to the bit";
}

/// A raw client sends this in state ready; returns what ended the server's session.
std::string fault_of(RawMessage const& message, bool has_saver)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server, Schedule::serial, has_saver); });
    RawPeer peer = RawPeer::client(server.endpoint());
    peer.send(raw_hello());
    EXPECT_TRUE(peer.receive());
    peer.send(raw_mesh(small_mesh()));
    EXPECT_TRUE(peer.receive());
    EXPECT_TRUE(peer.receive());
    peer.send(message);
    return served.get().fault;
}

TEST(CheckpointRequests, OffTheWireAreChecked)
{
    EXPECT_THAT(fault_of(raw_checkpoint(), false), testing::HasSubstr("this server saves none"));
    RawMessage backwards = raw_checkpoint();
    backwards.envelope.mutable_checkpoint()->set_complete_step(-1);
    EXPECT_THAT(fault_of(backwards, true), testing::HasSubstr("step -1"));
    RawMessage timeless = raw_checkpoint();
    timeless.envelope.mutable_checkpoint()->set_time(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THAT(fault_of(timeless, true), testing::HasSubstr("Checkpoint is nan"));
}

TEST(CheckpointRequests, WithNumbersThatCannotBeAreTheProgramsFault)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server, Schedule::serial, true); });
    Client client(client_options(server.endpoint()));
    client.connect({1.2, 1.8e-5});
    client.send_mesh(view_of(small_mesh()));
    EXPECT_FAULT(client.save_checkpoint(std::numeric_limits<double>::infinity(), 0), Fault::user, "must be finite");
    EXPECT_FAULT(client.save_checkpoint(0, -3), Fault::user, "step -3");
    client.finish("done");
    EXPECT_EQ(served.get().fault, "");
}

}  // namespace
}  // namespace gimdem::test

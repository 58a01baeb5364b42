// SPDX-License-Identifier: BSD-3-Clause
/// The schedule iterated between a client and a server: steps that are repeated, and who may not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "Faults.hpp"
#include "Pair.hpp"
#include "RawMessages.hpp"
#include "RawPeer.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

/// Step and pass of each fluid that a server received, with the first number of its velocity and the residual.
struct Received
{
    std::int64_t step;
    int pass;
    double velocity, residual;

    friend bool operator==(Received const& a, Received const& b)
    {
        return a.step == b.step && a.pass == b.pass && a.velocity == b.velocity && a.residual == b.residual;
    }
};

/// The solid that answers a fluid is SolidArrays(cells, 100 step + pass).
std::vector<Received> serve(Server& server, ServerTerms const& terms)
{
    std::vector<Received> all;
    server.wait_for_client(terms);
    auto const cells = static_cast<std::size_t>(server.receive_mesh().cell_count);
    server.accept_mesh(SolidArrays(cells, 0).view());
    while (auto const fluid = server.receive_fluid())
    {
        all.push_back({fluid->step.number, fluid->pass, fluid->fields.velocity[0], fluid->residual});
        double const number = 100 * static_cast<double>(fluid->step.number) + fluid->pass;
        server.send_solid(SolidArrays(cells, number).view(), {});
    }
    return all;
}

/// How often step n is computed: 1 to 4 times.
int passes_of(int n)
{
    return 1 + n * n % 4;
}

class IteratedRun : public testing::TestWithParam<std::pair<std::string, bool>>
{
};

TEST_P(IteratedRun, RepeatsStepsUntilTheClientEndsThem)
{
    auto const [transport, in_shared_memory] = GetParam();
    ServerOptions options = server_options(transport == "ipc" ? unused_ipc_endpoint() : any_tcp_endpoint());
    options.shared_memory = in_shared_memory;
    Server server(options);
    auto served = in_background([&] { return serve(server, server_terms(Schedule::iterated)); });
    Mesh const mesh = BoxMesh::make({8, 8, 8}, {1, 1, 1});  // so many cells that fields go through shared memory
    auto const cells = static_cast<std::size_t>(mesh.cell_count);

    ClientOptions wishes = client_options(server.endpoint());
    wishes.iterates = true;
    Client client(wishes);
    EXPECT_EQ(client.connect({1.2, 1.8e-5}).schedule, Schedule::iterated);
    client.send_mesh(view_of(mesh));
    std::vector<Received> expected;
    double residual = 0;
    for (int n = 1; n <= 6; ++n)
    {
        expected.push_back({n, 0, 10.0 * n, residual});
        client.begin_step(step(n), FluidArrays(cells, 10.0 * n).view());
        EXPECT_EQ(client.solid().drag_coefficient[0], 100 * n);
        for (int pass = 1; pass < passes_of(n); ++pass)
        {
            expected.push_back({n, pass, 10.0 * n + pass, 0.5 / pass});
            SolidFields const& solid = client.iterate_step(FluidArrays(cells, 10.0 * n + pass).view(), 0.5 / pass);
            EXPECT_EQ(to_vector(solid.drag_momentum), SolidArrays(cells, 100 * n + pass).drag_momentum);
        }
        residual = 1e-3 * n;
        client.end_step({}, residual);
    }
    client.finish("end time reached");

    EXPECT_EQ(served.get(), expected);
}

INSTANTIATE_TEST_SUITE_P(Ways, IteratedRun,
                         testing::Values(std::pair{"ipc", true}, std::pair{"ipc", false}, std::pair{"tcp", false}),
                         [](auto const& way)
                         { return way.param.first + (way.param.second ? "_shared_memory" : "_frames"); });

TEST(Iterated, IsRefusedToAClientThatCannot)
{
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { return serve(server, server_terms(Schedule::iterated)); });
    Client client(client_options(server.endpoint()));
    EXPECT_FAULT(client.connect({1.2, 1.8e-5}), Fault::peer, "cannot repeat a step");
    EXPECT_FAULT(served.get(), Fault::user, "choose schedule serial");
}

TEST(Iterated, NoOtherScheduleRepeatsSteps)
{
    for (Schedule const schedule : {Schedule::serial, Schedule::overlapped})
    {
        Server server(server_options(unused_ipc_endpoint()));
        auto served = in_background([&] { return serve(server, server_terms(schedule)); });
        ClientOptions wishes = client_options(server.endpoint());
        wishes.iterates = true;
        Client client(wishes);
        client.connect({1.2, 1.8e-5});
        client.send_mesh(view_of(small_mesh()));
        client.begin_step(step(1), FluidArrays(24, 1).view());
        EXPECT_FAULT(client.iterate_step(FluidArrays(24, 1).view()), Fault::user, "iterate_step() is illegal");
        client.end_step();
        client.finish("done");
        served.get();
    }
}

/// What a server tells a raw client of the last fluid.
std::string told(Schedule schedule, std::vector<RawMessage> const& fluids)
{
    Server server(server_options(any_tcp_endpoint()));
    auto served = in_background([&] { return serve(server, server_terms(schedule)); });
    RawPeer peer = RawPeer::client(server.endpoint());
    RawMessage hello = raw_hello();
    hello.envelope.mutable_hello()->set_iterates(true);
    peer.send(hello);
    peer.set_session(peer.receive()->envelope.session());
    peer.send(raw_mesh(small_mesh()));
    peer.receive();  // MeshAccepted
    for (RawMessage const& fluid : fluids)
    {
        peer.receive();  // the solid of before
        peer.send(fluid);
    }
    std::string const error = peer.receive_error();
    EXPECT_FAULT(served.get(), Fault::protocol, "out of order");
    return error;
}

RawMessage pass(int number, int iteration)
{
    RawMessage message = raw_fluid(number, 0, 1e-3, 24, {{"velocity", 3}, {"pressure_gradient", 3}});
    message.envelope.set_iteration(iteration);
    if (iteration > 0) message.envelope.mutable_fluid_state()->mutable_rewind();
    return message;
}

TEST(Iterated, ServerRefusesPassesOutOfOrder)
{
    EXPECT_THAT(told(Schedule::iterated, {pass(1, 1)}), testing::HasSubstr("only the last step can be repeated"));
    EXPECT_THAT(told(Schedule::iterated, {pass(1, 0), pass(1, 2)}), testing::HasSubstr("pass 2 of step 1"));
    EXPECT_THAT(told(Schedule::serial, {pass(1, 0), pass(1, 1)}), testing::HasSubstr("not iterated"));
}

}  // namespace
}  // namespace gimdem::test

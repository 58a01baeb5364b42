// SPDX-License-Identifier: BSD-3-Clause
/// Whole runs, as the headers of Client and Server show them.
#include <gtest/gtest.h>

#include <filesystem>

#include "Pair.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

int constexpr steps = 5;

struct Seen
{
    ClientInfo client;
    Mesh mesh;
    std::vector<std::vector<double>> velocities;
    std::vector<FluidState> states;
    std::string goodbye;
};

/// The solid of step n is SolidArrays(cells, n).
Seen serve(Server& server, ServerTerms const& terms)
{
    Seen seen;
    seen.client = server.wait_for_client(terms);
    seen.mesh = server.receive_mesh();
    auto const cells = static_cast<std::size_t>(seen.mesh.cell_count);
    server.accept_mesh(SolidArrays(cells, 0).view());
    while (auto fluid = server.receive_fluid())
    {
        seen.velocities.push_back(to_vector(fluid->fields.velocity));
        seen.states.push_back(*fluid);
        server.send_solid(SolidArrays(cells, static_cast<double>(fluid->step.number)).view(), {0.25, 0.5, 0.125});
    }
    seen.goodbye = server.goodbye_reason();
    return seen;
}

struct Scheme
{
    std::string transport;
    Schedule schedule;
};

class Run : public testing::TestWithParam<Scheme>
{
protected:
    std::string endpoint() const { return GetParam().transport == "ipc" ? unused_ipc_endpoint() : any_tcp_endpoint(); }
};

TEST_P(Run, ExchangesEveryNumberOfEveryStep)
{
    auto const schedule = GetParam().schedule;
    Server server(server_options(endpoint()));
    auto served = in_background([&] { return serve(server, server_terms(schedule)); });
    Mesh const mesh = small_mesh();
    auto const cells = static_cast<std::size_t>(mesh.cell_count);

    Client client(client_options(server.endpoint()));
    Welcome const welcome = client.connect({1.2, 1.8e-5});
    client.send_mesh(view_of(mesh));
    EXPECT_EQ(to_vector(client.solid().void_fraction), SolidArrays(cells, 0).void_fraction);
    for (int n = 1; n <= steps; ++n)
    {
        FluidArrays const fluid(cells, n);
        SolidFields const& solid = client.begin_step(step(n), fluid.view(), {{"courant_max", 0.1 * n, "1"}});
        int const level = schedule == Schedule::serial ? n : n - 1;
        SolidArrays const expected(cells, level);
        EXPECT_EQ(to_vector(solid.void_fraction), expected.void_fraction) << "step " << n;
        EXPECT_EQ(to_vector(solid.drag_coefficient), expected.drag_coefficient) << "step " << n;
        EXPECT_EQ(to_vector(solid.drag_momentum), expected.drag_momentum) << "step " << n;
        EXPECT_TRUE(solid.momentum_source.empty());
        client.end_step({1.0 * n, 0, 0.5});
    }
    client.finish("end time reached");
    Seen const seen = served.get();

    EXPECT_EQ(welcome.server, "test server 1");
    EXPECT_EQ(welcome.title, "a test");
    EXPECT_EQ(welcome.schedule, schedule);
    EXPECT_EQ(welcome.end_time, 1.5);
    EXPECT_EQ(seen.client.name, "test client 1");
    EXPECT_EQ(seen.client.schedule, std::nullopt) << "no wish";
    EXPECT_EQ(seen.client.fluid.density, 1.2);
    EXPECT_EQ(seen.client.fluid.viscosity, 1.8e-5);
    EXPECT_EQ(seen.mesh.points, mesh.points);
    EXPECT_EQ(seen.goodbye, "end time reached");
    ASSERT_EQ(seen.states.size(), static_cast<std::size_t>(steps));
    for (int n = 1; n <= steps; ++n)
    {
        auto const& state = seen.states[static_cast<std::size_t>(n - 1)];
        EXPECT_EQ(seen.velocities[static_cast<std::size_t>(n - 1)], FluidArrays(cells, n).velocity);
        EXPECT_EQ(state.step.number, n);
        EXPECT_EQ(state.monitors.at(0).value, 0.1 * n);
        EXPECT_EQ(state.previous.compute, n - 1.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Run,
                         testing::Values(Scheme{"ipc", Schedule::serial}, Scheme{"ipc", Schedule::overlapped},
                                         Scheme{"tcp", Schedule::serial}, Scheme{"tcp", Schedule::overlapped}),
                         [](auto const& scheme) {
                             return scheme.param.transport +
                                    (scheme.param.schedule == Schedule::serial ? "_serial" : "_overlapped");
                         });

TEST(RunWish, OfTheClientDecidesTheSchedule)
{
    for (Schedule const wish : {Schedule::serial, Schedule::overlapped})
        for (Schedule const offered : {Schedule::serial, Schedule::overlapped})
        {
            Server server(server_options(unused_ipc_endpoint()));
            auto served = in_background([&] { return serve(server, server_terms(offered)); });
            ClientOptions options = client_options(server.endpoint());
            options.schedule = wish;
            Client client(options);
            EXPECT_EQ(client.connect({1.2, 1.8e-5}).schedule, wish);
            client.send_mesh(view_of(small_mesh()));
            client.finish("done");
            EXPECT_EQ(served.get().client.schedule, wish);
        }
}

}  // namespace
}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Steps that the real server repeats.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ServerProcess.hpp"
#include "UniformFluid.hpp"
#include "gimdem/coupling/FixedPoint.hpp"
#include "output/Snapshot.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

std::size_t constexpr cells = 4 * 4 * 8;
double constexpr dt = 1e-4;  ///< [s]
int constexpr steps = 8;

Client iterating_client(ServerProcess const& server)
{
    ClientOptions options = client_options(server.endpoint());
    options.iterates = true;
    return Client(options);
}

std::vector<double> numbers_of(SolidFields const& solid)
{
    std::vector<double> numbers;
    for (auto const& field : {solid.void_fraction, solid.momentum_source, solid.drag_coefficient, solid.drag_momentum})
        numbers.insert(numbers.end(), field.begin(), field.end());
    return numbers;
}

/// The solid of every step, and the last state of the particles.
struct Outcome
{
    std::vector<std::vector<double>> solids;
    std::vector<double> position, velocity;
    double time = 0;
};

/// Steps in a fluid whose velocity changes from step to step; `in_vain`: passes before, through other fluids.
Outcome run(int in_vain)
{
    SmallCase settings;
    settings.schedule = "iterated";
    ServerProcess server(unused_ipc_endpoint(), settings);
    Client client = iterating_client(server);
    client.connect(air);
    client.send_mesh(view_of(SmallCase::mesh()));
    Outcome outcome;
    for (int n = 1; n <= steps; ++n)
    {
        UniformFluid const fluid(cells, {0.5, -0.25 * n, 1});
        Step const step{n, dt * (n - 1), dt};
        if (in_vain > 0)
        {
            client.begin_step(step, UniformFluid(cells, {40, 3, -7}).view());
            for (int pass = 1; pass < in_vain; ++pass)
                client.iterate_step(UniformFluid(cells, {0, 30.0 * pass, 9}).view());
            outcome.solids.push_back(numbers_of(client.iterate_step(fluid.view())));
        }
        else
            outcome.solids.push_back(numbers_of(client.begin_step(step, fluid.view())));
        client.end_step();
    }
    client.finish("all steps done");
    server.expect_end(0, "figure: passes_per_step = " + std::to_string(in_vain + 1));
    output::SnapshotReader const state(server.checkpoints().back(), "checkpoint");
    outcome.position = state.doubles("position");
    outcome.velocity = state.doubles("velocity");
    outcome.time = state.number("time");
    return outcome;
}

TEST(IteratedServer, GivesTheSameBitsWhateverWasTriedBefore)
{
    Outcome const straight = run(0);
    for (int const in_vain : {1, 3})
    {
        Outcome const repeated = run(in_vain);
        EXPECT_EQ(straight.solids, repeated.solids);
        EXPECT_EQ(straight.position, repeated.position);
        EXPECT_EQ(straight.velocity, repeated.velocity);
        EXPECT_EQ(straight.time, repeated.time);
    }
    EXPECT_NEAR(straight.time, steps * dt, 1e-15);
}

TEST(IteratedServer, FindsTheFluidThatTakesWhatTheParticlesGive)
{
    // A fluid of little mass, one body, pushed by 300 beads: what comes of a step pushes back within the step.
    SmallCase settings;
    settings.schedule = "iterated\"\ntolerance = 1e-9\nmax_passes = 30\n#\"";
    ServerProcess server(unused_ipc_endpoint(), settings);
    Client client = iterating_client(server);
    Iteration const iteration = client.connect(air).iteration;
    EXPECT_EQ(iteration.tolerance, 1e-9);
    client.send_mesh(view_of(SmallCase::mesh()));

    double constexpr fluid_mass = 2e-9;  // so light that explicit steps would overshoot 40 times
    double velocity = 1, given = 0;
    FluidFixedPoint fixed_point(iteration);
    for (int n = 1; n <= 3; ++n)
    {
        double const begin = velocity;
        UniformFluid fluid(cells, {0, 0, begin});
        client.begin_step({n, dt * (n - 1), dt}, fluid.view());
        fixed_point.start(fluid.view());
        while (true)
        {
            given = 0;
            for (std::size_t c = 0; c < cells; ++c)
                given += dt * client.solid().momentum_source[3 * c + 2] * SmallCase::cell_volume;
            velocity = begin + given / fluid_mass;
            fluid = UniformFluid(cells, {0, 0, velocity});
            if (!fixed_point.improve(fluid.view())) break;
            client.iterate_step(fixed_point.guess(), fixed_point.residual());
        }
        client.end_step({}, fixed_point.residual());
        EXPECT_TRUE(fixed_point.converged()) << fixed_point.residual();
        EXPECT_GT(fixed_point.passes(), 2);
        EXPECT_LT(fixed_point.factor(), 0.2) << "not stiff, nothing shown";
        // It comes to the beads' velocity from above, without swinging.
        EXPECT_GT(velocity, 0);
        EXPECT_LT(velocity, begin);
    }
    client.finish("all steps done");
    server.expect_end(0, "figure: residual_worst");

    output::SnapshotReader const state(server.checkpoints().back(), "checkpoint");
    auto const speeds = state.doubles("velocity");
    double gained = 0;
    for (std::size_t i = 0; i < speeds.size(); i += 4)
        gained += speeds[i + 2] / speeds[i + 3];
    // What the fluid lost since its velocity of 1 m/s; the tolerance of three steps, times the mass ratio.
    EXPECT_NEAR(gained / (fluid_mass * (1 - velocity)), 1, 1e-6);
}

}  // namespace
}  // namespace gimdem::test

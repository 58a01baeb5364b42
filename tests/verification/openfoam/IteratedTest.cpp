// SPDX-License-Identifier: BSD-3-Clause
/// gimdemFoam repeating its steps: gas and particles, each one body, come to a common velocity.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "Endpoint.hpp"
#include "FluidCase.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

double constexpr void_fraction = 0.6, coefficient = 2e4;  ///< [kg/(m^3 s)]
double constexpr solid_density = 0.4 * 50;                ///< of the particles, per volume of the bed [kg/m^3]
double constexpr fluid_density = void_fraction * 1.28;    ///< of the gas, per volume of the bed [kg/m^3]

/// Velocities along z at the beginning of a step [m/s].
struct Bodies
{
    double fluid, particles;
    double momentum() const { return fluid_density * fluid + solid_density * particles; }
};

struct Outcome
{
    std::vector<Bodies> bodies;
    std::vector<int> passes;
    std::string log;
};

/// The share of its slip that the particles keep in a time dt, in a fluid of constant velocity.
double kept_slip(double dt)
{
    return std::exp(-coefficient * dt / solid_density);
}

Outcome relax(FluidCase const& fluid, Schedule schedule, Iteration const& iteration)
{
    ServerOptions options;
    options.endpoint = unused_ipc_endpoint();
    options.name = "particles that move as one";
    options.timeout = 10;
    options.connect_time = 20;
    Server server(options);
    FluidProcess process(fluid);
    process.start("-endpoint " + server.endpoint());

    Outcome outcome;
    ServerTerms terms;
    terms.title = "one body";
    terms.schedule = schedule;
    terms.end_time = fluid.end_time;
    terms.needs = {field::velocity};  // no pressure gradient: there is none but noise, which never stands still
    terms.iteration = iteration;
    server.wait_for_client(terms);
    auto const cells = static_cast<std::size_t>(server.receive_mesh().cell_count);
    std::vector<double> const alpha(cells, void_fraction), drag(cells, coefficient);
    std::vector<double> momentum(3 * cells, 0.0);
    auto const solid = [&]
    {
        SolidFields fields;
        fields.void_fraction = alpha;
        fields.drag_coefficient = drag;
        fields.drag_momentum = momentum;
        return fields;
    };
    server.accept_mesh(solid());
    double particles = 0, at_begin = 0;
    while (auto const state = server.receive_fluid())
    {
        double const seen = state->fields.velocity[2], dt = state->step.dt;
        if (state->pass == 0)
        {
            outcome.bodies.push_back({seen, particles});
            outcome.passes.push_back(0);
            at_begin = particles;
        }
        ++outcome.passes.back();
        particles = seen + (at_begin - seen) * kept_slip(dt);
        double const source = -solid_density * (particles - at_begin) / dt;
        for (std::size_t c = 0; c < cells; ++c)
            momentum[3 * c + 2] = source + coefficient * seen;
        server.send_solid(solid(), {});
    }
    int const code = process.wait();
    outcome.log = process.log();
    if (code != 0) throw std::runtime_error("gimdemFoam ended with " + std::to_string(code) + ":\n" + outcome.log);
    return outcome;
}

FluidCase gas()
{
    FluidCase fluid;
    fluid.ends = FluidCase::Ends::cyclic;
    fluid.cells = {1, 1, 10};
    fluid.gravity = {0, 0, 0};
    fluid.end_time = 0.002;
    fluid.momentum_predictor = true;
    fluid.correctors = 2;
    return fluid;
}

TEST(IteratedBodies, KeepTheirMomentumAndFollowTheImplicitSolution)
{
    FluidCase const fluid = gas();
    double const tolerance = 1e-7;
    Outcome const outcome = relax(fluid, Schedule::iterated, {tolerance, 30, 0.5, true});

    double const load = solid_density / fluid_density * (1 - kept_slip(fluid.time_step));
    ASSERT_EQ(outcome.bodies.size(), 20u);
    for (std::size_t n = 1; n < outcome.bodies.size(); ++n)
    {
        Bodies const &before = outcome.bodies[n - 1], &now = outcome.bodies[n];
        // The tolerance, times what a residual of one body is to the momentum of both.
        EXPECT_NEAR(now.momentum() / before.momentum(), 1, 1e2 * tolerance) << "step " << n;
        EXPECT_NEAR(now.fluid / ((before.fluid + load * before.particles) / (1 + load)), 1, 1e2 * tolerance)
            << "step " << n;
        // Linear: two passes, one to see it; the linear solvers' noise may ask for one more.
        EXPECT_LE(outcome.passes[n - 1], 5) << "step " << n;
    }
    EXPECT_GT(outcome.passes.front(), 2);
}

TEST(IteratedBodies, LoseMomentumWithoutIteration)
{
    // Not a virtue, but what the iteration is for: the particles took what gas of the old velocity gives.
    Outcome const outcome = relax(gas(), Schedule::serial, {});
    EXPECT_GT(std::abs(outcome.bodies[1].momentum() / outcome.bodies[0].momentum() - 1), 0.1);
}

TEST(IteratedBodies, SayWhichStepDidNotConverge)
{
    FluidCase fluid = gas();
    fluid.end_time = 2 * fluid.time_step;
    EXPECT_NE(relax(fluid, Schedule::iterated, {1e-12, 2, 0.5, false}).log.find("did not agree in 2 passes of step 1"),
              std::string::npos);
    try
    {
        relax(fluid, Schedule::iterated, {1e-12, 2, 0.5, true});
        ADD_FAILURE() << "a step that did not converge was accepted";
    }
    catch (CouplingError const& error)
    {
        EXPECT_NE(std::string(error.what()).find("did not agree in 2 passes of step 1"), std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace gimdem::test

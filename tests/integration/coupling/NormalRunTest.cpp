// SPDX-License-Identifier: BSD-3-Clause
/// Whole runs with the real server: what comes over the wire conserves volume and momentum.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ServerProcess.hpp"
#include "UniformFluid.hpp"
#include "output/Snapshot.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

double constexpr pi = 3.14159265358979323846;
double constexpr dt = 1e-4;  ///< [s]
int constexpr steps = 20;
double constexpr particle_volume = pi / 6 * SmallCase::diameter * SmallCase::diameter * SmallCase::diameter;  ///< [m^3]
std::size_t constexpr cells = 4 * 4 * 8;

struct Scheme
{
    std::string transport;
    std::string schedule;
};

class NormalRun : public testing::TestWithParam<Scheme>
{
};

/// Sums of one SolidFields over the box.
struct Totals
{
    double solid_volume = 0;        ///< [m^3]
    std::array<double, 3> force{};  ///< on the fluid, S V [N]
    double worst_split = 0;         ///< |S - (K u_p - K v)| where it is largest [N/m^3]
    double largest_source = 0;      ///< [N/m^3]
};

Totals totals_of(SolidFields const& solid, UniformFluid const& fluid)
{
    Totals totals;
    for (std::size_t c = 0; c < cells; ++c)
    {
        EXPECT_GT(solid.void_fraction[c], 0);
        EXPECT_LE(solid.void_fraction[c], 1);
        totals.solid_volume += (1 - solid.void_fraction[c]) * SmallCase::cell_volume;
        for (std::size_t k = 0; k < 3; ++k)
        {
            double const source = solid.momentum_source[3 * c + k];
            double const split = solid.drag_momentum[3 * c + k] - solid.drag_coefficient[c] * fluid.velocity(k);
            totals.force[k] += source * SmallCase::cell_volume;
            totals.worst_split = std::max(totals.worst_split, std::abs(source - split));
            totals.largest_source = std::max(totals.largest_source, std::abs(source));
        }
    }
    return totals;
}

/// What the server's particles have gained since they were at rest [N s].
std::array<double, 3> final_momentum(ServerProcess const& server)
{
    output::SnapshotReader const state(server.checkpoints().back(), "checkpoint");
    std::vector<double> const velocity = state.doubles("velocity");  // shape=(n, 4): velocity and inverse mass
    EXPECT_EQ(velocity.size(), 4u * SmallCase::particle_count);
    std::array<double, 3> momentum{};
    for (std::size_t i = 0; i < velocity.size(); ++i)
        if (i % 4 != 3) momentum[i % 4] += velocity[i] * particle_volume * SmallCase::particle_density;
    return momentum;
}

TEST_P(NormalRun, ConservesVolumeAndMomentum)
{
    SmallCase settings;
    settings.schedule = GetParam().schedule;
    ServerProcess server(endpoint_over(GetParam().transport), settings);
    Mesh const mesh = SmallCase::mesh();
    UniformFluid const fluid(cells, {0.5, -0.25, 1});

    Client client(client_options(server.endpoint()));
    Welcome const welcome = client.connect(air);
    client.send_mesh(view_of(mesh));
    std::array<double, 3> given{};  // to the fluid [N s]
    for (int n = 1; n <= steps; ++n)
    {
        client.begin_step({n, dt * (n - 1), dt}, fluid.view(), {{"courant_max", 0.1, "1"}});
        client.end_step({1e-3, 0, 0});
        Totals const totals = totals_of(client.solid(), fluid);
        // Sums of some hundred numbers, and 1 - (1 - x) with x about 0.01.
        EXPECT_NEAR(totals.solid_volume / (SmallCase::particle_count * particle_volume), 1, 1e-11) << "step " << n;
        EXPECT_LE(totals.worst_split, 1e-12 * totals.largest_source) << "step " << n;
        for (std::size_t k = 0; k < 3; ++k)
            given[k] += totals.force[k] * dt;
    }
    client.finish("all steps done");

    EXPECT_EQ(welcome.title, "a small box");
    EXPECT_EQ(welcome.schedule == Schedule::serial ? "serial" : "overlapped", GetParam().schedule);
    server.expect_end(0, "figure: momentum_imbalance");
    std::array<double, 3> const gained = final_momentum(server);
    for (std::size_t k = 0; k < 3; ++k)
    {
        EXPECT_GT(std::abs(gained[k]), 1e-9) << "nothing moved, nothing shown";
        EXPECT_NEAR(-given[k] / gained[k], 1, 1e-11) << "component " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, NormalRun,
                         testing::Values(Scheme{"ipc", "serial"}, Scheme{"ipc", "overlapped"}, Scheme{"tcp", "serial"},
                                         Scheme{"tcp", "overlapped"}),
                         [](auto const& scheme) { return scheme.param.transport + "_" + scheme.param.schedule; });

/// The solid after some steps, all of its numbers.
std::vector<double> solid_after_run(Schedule schedule)
{
    ServerProcess server(unused_ipc_endpoint());
    ClientOptions options = client_options(server.endpoint());
    options.schedule = schedule;
    Client client(options);
    client.connect(air);
    client.send_mesh(view_of(SmallCase::mesh()));
    UniformFluid const fluid(cells, {0.5, -0.25, 1});
    for (int n = 1; n <= steps; ++n)
    {
        client.begin_step({n, dt * (n - 1), dt}, fluid.view());
        client.end_step();
    }
    std::vector<double> numbers;
    for (auto const& field : {client.solid().void_fraction, client.solid().momentum_source})
        numbers.insert(numbers.end(), field.begin(), field.end());
    client.finish("all steps done");
    server.expect_end(0, "");
    return numbers;
}

TEST(NormalRunWish, ClientDecidesTheScheduleAndTheServerAnswersAlike)
{
    // The fluid does not depend on the particles here, so the schedule makes no difference to them: not in one bit.
    EXPECT_EQ(solid_after_run(Schedule::serial), solid_after_run(Schedule::overlapped));
}

TEST(CoupledRun, PistonOfTheCaseFileSweepsParticlesAlong)
{
    SmallCase settings;
    settings.more =
        "[[wall]]\nname = \"piston\"\nshape = \"plane\"\npoint = [0.0, 0.0, 0.002]\nnormal = [0.0, 0.0, 1.0]\n"
        "velocity = [0.0, 0.0, 2.0]\n";
    ServerProcess server(unused_ipc_endpoint(), settings);
    Client client(client_options(server.endpoint()));
    client.connect(air);
    client.send_mesh(view_of(SmallCase::mesh()));
    UniformFluid const still(cells, {0, 0, 0});
    for (int n = 1; n <= 100; ++n)
    {
        client.begin_step({n, dt * (n - 1), dt}, still.view());
        client.end_step();
    }
    client.finish("all steps done");
    server.expect_end(0, "");

    output::SnapshotReader const state(server.checkpoints().back(), "checkpoint");
    auto const position = state.doubles("position"), velocity = state.doubles("velocity");
    double lowest = 1, fastest = 0;
    for (std::size_t i = 0; i < position.size(); i += 4)
    {
        lowest = std::min(lowest, position[i + 2]);
        fastest = std::max(fastest, velocity[i + 2]);
    }
    // The piston has come from 2 to 22 mm; beads of radius 1 mm were from 11 mm on. An impact at 2 m/s dents a bead by
    // a quarter of its radius: (5 pi rho v^2 / (4 E*))^0.4. None stays behind, none is thrown beyond the sum of
    // 1.9 times the piston's speed and what a chain of beads can add.
    EXPECT_NEAR(lowest, 0.022 + 1e-3, 0.3e-3);
    EXPECT_NEAR(fastest, 1.9 * 2, 0.3);
}

}  // namespace
}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Coupling steps of changing length with the real server, in both schedules.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "ServerProcess.hpp"
#include "UniformFluid.hpp"
#include "output/Snapshot.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

std::size_t constexpr cells = 4 * 4 * 8;

/// Length of step n [s]: never twice the same, and seldom a whole number of DEM steps of 10 us.
double length_of(int n)
{
    return 1e-4 * (1 + 0.9 * std::sin(1.0 * n));
}

/// Numbers of one column of a CSV file of the run.
std::vector<double> column(std::filesystem::path const& file, std::string const& name)
{
    std::ifstream in(file);
    std::vector<double> values;
    std::size_t index = 0;
    for (std::string line; std::getline(in, line);)
    {
        std::istringstream row(line);
        std::vector<std::string> words;
        for (std::string word; std::getline(row, word, ',');)
            words.push_back(word);
        if (line.rfind("step [1]", 0) == 0)
            index = static_cast<std::size_t>(std::find(words.begin(), words.end(), name) - words.begin());
        else
            values.push_back(std::stod(words.at(index)));
    }
    return values;
}

double sum_of(std::vector<double> const& values)
{
    double sum = 0;
    for (double const value : values)
        sum += value;
    return sum;
}

class VariableSteps : public testing::TestWithParam<std::string>
{
};

TEST_P(VariableSteps, GiveTheParticlesWhatTheyTakeFromTheFluid)
{
    int constexpr steps = 30;
    SmallCase settings;
    settings.schedule = GetParam();
    ServerProcess server(unused_ipc_endpoint(), settings);
    UniformFluid const fluid(cells, {0.5, -0.25, 1});

    Client client(client_options(server.endpoint()));
    client.connect(air);
    client.send_mesh(view_of(SmallCase::mesh()));
    double time = 0, given = 0;  // to the fluid along z [N s]
    for (int n = 1; n <= steps; ++n)
    {
        client.begin_step({n, time, length_of(n)}, fluid.view());
        client.end_step({1e-3, 0, 0});
        for (std::size_t c = 0; c < cells; ++c)
            given += client.solid().momentum_source[3 * c + 2] * SmallCase::cell_volume * length_of(n);
        time += length_of(n);
    }
    client.finish("all steps done");
    server.expect_end(0, "figure: overlap_efficiency");

    output::SnapshotReader const state(server.checkpoints().back(), "checkpoint");
    EXPECT_NEAR(state.number("time"), time, 1e-15);  // both add the same numbers
    auto const velocity = state.doubles("velocity");
    double gained = 0;
    for (std::size_t i = 0; i < velocity.size(); i += 4)
        gained += velocity[i + 2] / velocity[i + 3];
    EXPECT_GT(gained, 1e-9);
    EXPECT_NEAR(-given / gained, 1, 1e-11);  // rounding of some thousand numbers

    // The last step is not in the file: of its fluid the client never told.
    auto const file = server.result("coupling.csv");
    auto const lengths = column(file, "dt [s]"), times = column(file, "time [s]"), dem = column(file, "dem_steps [1]");
    ASSERT_EQ(lengths.size(), steps - 1u);
    EXPECT_NEAR(sum_of(lengths), time - length_of(steps), 1e-15);
    double begin = 0;
    for (std::size_t n = 0; n < lengths.size(); ++n)
    {
        EXPECT_NEAR(times[n], begin, 1e-15);
        EXPECT_EQ(dem[n], std::ceil(lengths[n] / 1e-5));
        begin += lengths[n];
    }
    for (double const compute : column(file, "cfd [s]"))
        EXPECT_EQ(compute, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Schedules, VariableSteps, testing::Values("serial", "overlapped"),
                         [](auto const& schedule) { return schedule.param; });

TEST(FluidStepsOfTheCase, AreToldToTheClient)
{
    SmallCase settings;
    settings.schedule = "serial\"\nfluid_steps = 4\n#\"";
    ServerProcess server(unused_ipc_endpoint(), settings);
    Client client(client_options(server.endpoint()));
    EXPECT_EQ(client.connect(air).fluid_steps, 4);
    client.finish("asked");
    server.expect_end(1, "said goodbye before it sent its mesh");
}

}  // namespace
}  // namespace gimdem::test

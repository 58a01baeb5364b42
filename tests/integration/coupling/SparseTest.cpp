// SPDX-License-Identifier: BSD-3-Clause
/// The real server with a client that sends the cells that are needed, and with one that sends all: the same to the
/// bit, on the wire, in the particles, and in every file.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

#include "ServerProcess.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

double constexpr dt = 5e-3;  ///< [s]
int constexpr steps = 10;
FluidProperties constexpr water{1000, 1e-3};
BoxMesh::Size constexpr size{6, 6, 40};
std::size_t constexpr cells = 6 * 6 * 40;

Mesh tall_mesh()
{
    return BoxMesh::make(size, {0.06, 0.06, 0.4});
}

/// Beads at the bottom of a tall box, carried upward by water at 6 m/s: they cross three cells of 10 mm in a coupling
/// step, so that the cells that the server asked for are not always enough.
class TallCase : public SmallCase
{
public:
    TallCase(std::string const& schedule_in_force, bool with_inlet)
    {
        schedule = schedule_in_force;
        more =
            "sample_interval = 2e-3\ninlet = \"bottom\"\noutlet = \"top\"\n"
            "planes = [{ name = \"middle\", point = [0.0, 0.0, 0.203], normal = [0.0, 0.0, 1.0] }]\n";
        if (with_inlet)
            more +=
                "[[inlets]]\nmaterial = \"bead\"\ndiameter = 2e-3\nmass_rate = 2e-3\nvelocity = [0.0, 0.0, -0.5]\n"
                "box = [[0.01, 0.01, 0.3], [0.05, 0.05, 0.35]]\ninterval = 6e-3\n";
    }

    std::string text() const
    {
        std::string text = SmallCase::text();
        auto const replace = [&](std::string const& from, std::string const& to)
        {
            EXPECT_NE(text.find(from), std::string::npos) << from;
            text.replace(text.find(from), from.size(), to);
        };
        replace("[0.054, 0.054, 0.11]", "[0.054, 0.054, 0.04]");
        replace("particle_interval = 0.0", "particle_interval = 0.0071");
        replace("pressure_gradient = false", "pressure_gradient = true");
        return text;
    }
};

/// Every number another one in every cell and step, and gradients strong enough to matter.
struct WildFluid
{
    explicit WildFluid(int step)
    {
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i] = std::sin(0.37 * static_cast<double>(i) + step);
        for (std::size_t i = 0; i < velocity.size(); ++i)
            velocity[i] = 0.5 * numbers[i] + (i % 3 == 2 ? 6.0 : 0.0);
    }

    FluidFields view() const
    {
        FluidFields fields;
        fields.velocity = velocity;
        fields.velocity_gradient = {numbers.data(), 9 * cells};
        fields.pressure_gradient = {numbers.data() + 5, 3 * cells};
        fields.void_fraction_gradient = {numbers.data() + 7, 3 * cells};
        fields.pressure = {numbers.data() + 9, cells};
        return fields;
    }

    std::vector<double> numbers = std::vector<double>(9 * cells + 9), velocity = std::vector<double>(3 * cells);
};

/// All that a run leaves behind.
struct Outcome
{
    std::vector<double> solids;                ///< of all steps
    std::map<std::string, std::string> files;  ///< by name, their bytes
    double bytes = 0;                          ///< of the exchange
    std::string output;                        ///< of the server
};

std::string contents(std::filesystem::path const& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Outcome run(std::string const& transport, TallCase const& settings, bool sparse)
{
    ServerProcess server(endpoint_over(transport), settings.text());
    ClientOptions options = client_options(server.endpoint());
    options.encodings.sparse = sparse;
    Client client(options);
    Outcome outcome;
    EXPECT_EQ(client.connect(water).encodings.sparse, sparse);
    client.send_mesh(view_of(tall_mesh()));
    double const before = client.exchange_times().bytes;
    for (int n = 1; n <= steps; ++n)
    {
        WildFluid const fluid(n);
        client.begin_step({n, dt * (n - 1), dt}, fluid.view(), {{"courant_max", 0.1, "1"}});
        client.end_step();
        SolidFields const& solid = client.solid();
        for (auto const& field :
             {solid.void_fraction, solid.momentum_source, solid.drag_coefficient, solid.drag_momentum})
            outcome.solids.insert(outcome.solids.end(), field.begin(), field.end());
    }
    outcome.bytes = client.exchange_times().bytes - before;
    client.finish("all steps done");
    server.expect_end(0, "figure: momentum_imbalance");
    outcome.output = server.process().output();
    for (auto const& entry : std::filesystem::recursive_directory_iterator(server.result("")))
    {
        std::string const name = std::filesystem::relative(entry.path(), server.result(""));
        // These tell wall times and bytes.
        if (entry.is_regular_file() && name != "summary.json" && name != "coupling.csv" &&
            name.find(".json") == std::string::npos)
            outcome.files[name] = contents(entry.path());
    }
    return outcome;
}

double figure(std::string const& output, std::string const& name)
{
    auto const at = output.find("figure: " + name + " = ");
    EXPECT_NE(at, std::string::npos) << name << " in " << output;
    return at == std::string::npos ? NAN : std::stod(output.substr(at + name.size() + 11));
}

struct Way
{
    std::string transport, schedule;
    bool with_inlet;
};

class Sparse : public testing::TestWithParam<Way>
{
};

TEST_P(Sparse, RunIsTheRunWithAllCells)
{
    TallCase const settings(GetParam().schedule, GetParam().with_inlet);
    Outcome const all = run(GetParam().transport, settings, false);
    Outcome const some = run(GetParam().transport, settings, true);

    ASSERT_EQ(all.solids.size(), steps * 8 * cells);
    EXPECT_EQ(std::memcmp(all.solids.data(), some.solids.data(), all.solids.size() * sizeof(double)), 0);
    EXPECT_GE(all.files.size(), 5u) << "particles, cells, series and a checkpoint";
    EXPECT_TRUE(all.files.count("bed.csv") == 1 && all.files.count("summary.json") == 0);
    for (auto const& [name, bytes] : all.files)
    {
        ASSERT_EQ(some.files.count(name), 1u) << name;
        EXPECT_TRUE(some.files.at(name) == bytes) << name;
    }
    EXPECT_EQ(some.files.size(), all.files.size());
    EXPECT_EQ(figure(all.output, "whole_fluids_asked_for"), 0);
    if (GetParam().schedule == "serial")
        EXPECT_GT(figure(some.output, "whole_fluids_asked_for"), 0) << "the particles never left the needed cells";
    else  // an inlet may put them anywhere: then all cells of the fluid travel
        EXPECT_LT(some.bytes, (GetParam().with_inlet ? 0.95 : 0.8) * all.bytes);
}

INSTANTIATE_TEST_SUITE_P(Ways, Sparse,
                         testing::Values(Way{"ipc", "serial", false}, Way{"ipc", "overlapped", false},
                                         Way{"tcp", "serial", true}, Way{"ipc", "overlapped", true}),
                         [](auto const& way) {
                             return way.param.transport + "_" + way.param.schedule +
                                    (way.param.with_inlet ? "_with_inlet" : "");
                         });

}  // namespace
}  // namespace gimdem::test

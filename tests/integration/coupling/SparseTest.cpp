// SPDX-License-Identifier: BSD-3-Clause
/// The real server with a client that sends the cells that are needed, and with one that sends all: the same to the
/// bit, on the wire, in the particles, and in every file.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <future>
#include <map>

#include "MeshParts.hpp"
#include "ScriptedMesh.hpp"
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

/// Rows of a field, of those cells.
std::vector<double> rows(Span<double const> whole, std::vector<std::int32_t> const& of, std::size_t components)
{
    std::vector<double> some;
    for (std::int32_t const c : of)
        for (std::size_t k = 0; k < components; ++k)
            some.push_back(whole[static_cast<std::size_t>(c) * components + k]);
    return some;
}

/// A client of some ranks; each has slabs of the mesh, three cells high, so that the beads pass from rank to rank.
class Ranks
{
public:
    Ranks(std::string const& endpoint, int ranks, bool sparse)
        : pieces_(cut(tall_mesh(), dealt(static_cast<std::int32_t>(cells), ranks, 3 * 6 * 6)))
    {
        std::vector<std::string> endpoints{endpoint};
        clients_.reserve(pieces_.parts.size());
        for (int rank = 0; rank < ranks; ++rank)
        {
            ClientOptions options = client_options(endpoints[static_cast<std::size_t>(rank)]);
            options.encodings.sparse = sparse;
            if (ranks > 1) options.rank = {rank, ranks, run_number};
            Client& client = clients_.emplace_back(options);
            Welcome const& welcome = client.connect(water);
            EXPECT_EQ(welcome.encodings.sparse, sparse);
            endpoints.insert(endpoints.end(), welcome.rank_endpoints.begin(), welcome.rank_endpoints.end());
        }
        on_all([&](std::size_t rank) { clients_[rank].send_mesh(view_of(pieces_.parts[rank])); });
    }

    double bytes() const
    {
        double sum = 0;
        for (Client const& client : clients_)
            sum += client.exchange_times().bytes;
        return sum;
    }

    /// Returns all numbers of the solid.
    std::vector<double> take_step(int n)
    {
        WildFluid const fluid(n);
        on_all(
            [&](std::size_t rank)
            {
                FluidFields const whole = fluid.view();
                std::vector<std::int32_t> const& own = pieces_.cells[rank];
                std::vector<double> const velocity = rows(whole.velocity, own, 3),
                                          velocity_gradient = rows(whole.velocity_gradient, own, 9),
                                          pressure_gradient = rows(whole.pressure_gradient, own, 3),
                                          void_fraction_gradient = rows(whole.void_fraction_gradient, own, 3),
                                          pressure = rows(whole.pressure, own, 1);
                clients_[rank].begin_step(
                    {n, dt * (n - 1), dt},
                    {velocity, velocity_gradient, pressure_gradient, void_fraction_gradient, pressure},
                    {{"courant_max", 0.1, "1"}});
                clients_[rank].end_step();
            });
        std::vector<double> numbers;
        for (Client const& client : clients_)
        {
            SolidFields const& solid = client.solid();
            for (auto const& field :
                 {solid.void_fraction, solid.momentum_source, solid.drag_coefficient, solid.drag_momentum})
                numbers.insert(numbers.end(), field.begin(), field.end());
        }
        return numbers;
    }

    void finish()
    {
        on_all([&](std::size_t rank) { clients_[rank].finish("all steps done"); });
    }

private:
    void on_all(std::function<void(std::size_t)> const& body)
    {
        std::vector<std::future<void>> others;
        for (std::size_t rank = 1; rank < clients_.size(); ++rank)
            others.push_back(std::async(std::launch::async, [&body, rank] { body(rank); }));
        body(0);
        for (auto& other : others)
            other.get();
    }

    MeshParts pieces_;
    std::vector<Client> clients_;
};

Outcome run(std::string const& transport, TallCase const& settings, int ranks, bool sparse)
{
    ServerProcess server(endpoint_over(transport), settings.text());
    Ranks client(server.endpoint(), ranks, sparse);
    Outcome outcome;
    double const before = client.bytes();
    for (int n = 1; n <= steps; ++n)
    {
        std::vector<double> const solid = client.take_step(n);
        outcome.solids.insert(outcome.solids.end(), solid.begin(), solid.end());
    }
    outcome.bytes = client.bytes() - before;
    client.finish();
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
    int ranks = 1;
};

class Sparse : public testing::TestWithParam<Way>
{
};

TEST_P(Sparse, RunIsTheRunWithAllCells)
{
    TallCase const settings(GetParam().schedule, GetParam().with_inlet);
    Outcome const all = run(GetParam().transport, settings, GetParam().ranks, false);
    Outcome const some = run(GetParam().transport, settings, GetParam().ranks, true);

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
                                         Way{"tcp", "serial", true}, Way{"ipc", "overlapped", true},
                                         Way{"ipc", "serial", false, 2}, Way{"tcp", "overlapped", false, 3}),
                         [](auto const& way)
                         {
                             return way.param.transport + "_" + way.param.schedule +
                                    (way.param.with_inlet ? "_with_inlet" : "") +
                                    (way.param.ranks > 1 ? "_of_several_ranks" : "");
                         });

}  // namespace
}  // namespace gimdem::test

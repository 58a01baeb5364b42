// SPDX-License-Identifier: BSD-3-Clause
/// What gimdemFoam says, and to whom, when something is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <vector>

#include "Endpoint.hpp"
#include "PrescribedParticles.hpp"

namespace gimdem::test
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

FluidCase small()
{
    FluidCase fluid;
    fluid.cells = {1, 1, 10};
    fluid.end_time = 0.002;
    return fluid;
}

void replace(FluidProcess const& process, std::string const& name, std::string const& from, std::string const& to)
{
    std::ifstream in(process.folder() / name);
    std::string text(std::istreambuf_iterator<char>(in), {});
    auto const at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from << " is not in " << name;
    std::ofstream(process.folder() / name) << text.replace(at, from.size(), to);
}

/// Last line of the log without a server.
std::string words_alone(FluidProcess& process, std::string const& arguments)
{
    process.start(arguments);
    EXPECT_EQ(process.wait(), 1);
    std::string const log = process.log();
    EXPECT_THAT(log, Not(HasSubstr("Foam::error::printStack")));
    auto const at = log.rfind("gimdemFoam: ");
    return at == std::string::npos ? log : log.substr(at);
}

TEST(Fault, NamesAMissingKeyAndItsFile)
{
    FluidProcess process(small());
    replace(process, "constant/transportProperties", "rho", "density");

    EXPECT_THAT(words_alone(process, "-endpoint ipc:///nowhere"),
                AllOf(HasSubstr("rho"), HasSubstr("constant/transportProperties")));
}

TEST(Fault, NamesAMissingDictionary)
{
    FluidProcess process(small());
    std::filesystem::remove(process.folder() / "constant/g");

    EXPECT_THAT(words_alone(process, "-endpoint ipc:///nowhere"), HasSubstr("constant/g"));
}

TEST(Fault, AsksForAnEndpointThatIsNowhere)
{
    FluidProcess process(small());

    EXPECT_THAT(words_alone(process, ""), AllOf(HasSubstr("endpoint"), HasSubstr("couplingProperties")));
}

TEST(Fault, RefusesAnUnknownSchedule)
{
    FluidProcess process(small());

    EXPECT_THAT(words_alone(process, "-endpoint ipc:///nowhere -schedule both"),
                AllOf(HasSubstr("both"), HasSubstr("overlapped")));
}

TEST(Fault, RefusesATimeSchemeThatTheFacesDoNotKnow)
{
    FluidProcess process(small());
    replace(process, "system/fvSchemes", "Euler", "backward");

    EXPECT_THAT(words_alone(process, "-endpoint ipc:///nowhere"), AllOf(HasSubstr("backward"), HasSubstr("Euler")));
}

TEST(Fault, RefusesPressureDividedByDensity)
{
    FluidProcess process(small());
    replace(process, "0/p", "[1 -1 -2 0 0 0 0]", "[0 2 -2 0 0 0 0]");

    EXPECT_THAT(words_alone(process, "-endpoint ipc:///nowhere"), HasSubstr("0/p"));
}

TEST(Fault, OfTheFluidReachesTheServer)
{
    FluidCase fluid = small();
    fluid.ends = FluidCase::Ends::cyclic;
    fluid.end_time = 0.1;
    auto const storm = [](Vector, double t) { return Solid{0.5, 0, {0, 0, t < 0.01 ? 0 : 1e12}}; };

    try
    {
        run_with(fluid, storm);
        FAIL() << "ended well";
    }
    catch (std::runtime_error const& error)
    {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("the fluid diverged"), HasSubstr("reduce deltaT")));
    }
}

TEST(Fault, OfTheServerIsTold)
{
    FluidProcess process(small());
    coupling::ServerOptions options;
    options.endpoint = unused_ipc_endpoint();
    options.name = "failing server";
    options.timeout = 10;
    coupling::Server server(options);
    process.start("-endpoint " + server.endpoint());

    server.wait_for_client({"failing", coupling::Schedule::serial, 1, {}});
    server.receive_mesh();
    server.reject_mesh("cell 7 is inside out");

    EXPECT_EQ(process.wait(), 1);
    EXPECT_THAT(process.log(), HasSubstr("cell 7 is inside out"));
}

/// Serves some steps, then does `end` before it answers one more.
template <class End>
int exit_code_after(FluidProcess& process, int steps, End end)
{
    coupling::ServerOptions options;
    options.endpoint = unused_ipc_endpoint();
    options.name = "server that ends";
    options.timeout = 10;
    coupling::Server server(options);
    process.start("-endpoint " + server.endpoint());

    server.wait_for_client({"ending", coupling::Schedule::serial, 1, {}});
    std::vector<double> const void_fraction(static_cast<std::size_t>(server.receive_mesh().cell_count), 0.5);
    std::vector<double> const drag(void_fraction.size(), 100);
    std::vector<double> const momentum(3 * void_fraction.size(), 0);
    coupling::SolidFields solid;
    solid.void_fraction = void_fraction;
    solid.drag_coefficient = drag;
    solid.drag_momentum = momentum;
    server.accept_mesh(solid);
    for (int step = 0; server.receive_fluid(); ++step)
    {
        if (step == steps && !end(server)) break;
        server.send_solid(solid, {});
    }
    return process.wait();
}

TEST(Fault, OfTheServerLeavesTheLastFluid)
{
    FluidProcess process(small());

    EXPECT_EQ(exit_code_after(process, 7,
                              [](coupling::Server& server)
                              {
                                  server.abort("out of memory");
                                  return false;
                              }),
              1);

    EXPECT_THAT(process.log(), HasSubstr("out of memory"));
    EXPECT_TRUE(std::filesystem::exists(process.folder() / "0.0007" / "U"));
}

TEST(StopRequest, EndsTheRunInOrder)
{
    FluidProcess process(small());

    EXPECT_EQ(exit_code_after(process, 7,
                              [](coupling::Server& server)
                              {
                                  server.request_stop("Ctrl-C");
                                  return true;
                              }),
              0);

    EXPECT_THAT(process.log(), HasSubstr("Ctrl-C"));
    EXPECT_TRUE(std::filesystem::exists(process.folder() / "0.0008" / "U"));
}

TEST(ControlC, IsTheServersToAnswer)
{
    FluidProcess process(small());

    Fluid const state = run_with(
        process, 0.002,
        [](Vector, double) {
            return Solid{0.5, 100, {0, 0, 0}};
        },
        [&](Fluid const& now)
        {
            if (now.time > 0.00045 && now.time < 0.00055) ::kill(process.pid(), SIGINT);
        });

    EXPECT_NEAR(state.time, 0.0019, 1e-9);
}

}  // namespace
}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Whole runs in which only some cells travel, over every transport and in both schedules.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <optional>

#include "Faults.hpp"
#include "Pair.hpp"
#include "RawMessages.hpp"
#include "SparseSolid.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;

int constexpr steps = 12;
std::size_t constexpr cells = 2000;

Mesh mesh()
{
    return BoxMesh::make({10, 10, 20}, {0.1, 0.1, 0.2});
}

/// A bed that expands: in step n it fills so many cells at the bottom, and one stray cell above.
CellRuns bed(int n)
{
    return {{0, 100 + 40 * n}, {1500 + n, 1}};
}

SolidArrays solid(int n)
{
    return solid_in(bed(n), cells, n);
}

struct Seen
{
    std::vector<std::vector<double>> velocities;  ///< of all cells
    int incomplete = 0;                           ///< fluids that lacked cells
    int completed = 0;
};

/// Needs the velocity in the bed of the step before; in every third step it finds that this was not enough.
Seen serve(Server& server, Schedule schedule)
{
    Seen seen;
    server.wait_for_client(server_terms(schedule));
    server.receive_mesh();
    auto const cells_of = [](int n) {
        return StepCells{bed(n), {{{field::velocity}, bed(n)}, {{field::pressure_gradient}, {{7, 3}}}}};
    };
    server.accept_mesh(solid(0).view(), {}, cells_of(0));
    while (auto fluid = server.receive_fluid())
    {
        int const n = static_cast<int>(fluid->step.number);
        seen.incomplete += !fluid->is_complete;
        if (n % 3 == 0 && schedule == Schedule::serial)
        {
            server.complete(*fluid);
            server.complete(*fluid);  // costs nothing the second time
            ++seen.completed;
        }
        seen.velocities.push_back(to_vector(fluid->fields.velocity));
        server.send_solid(solid(n).view(), {}, cells_of(n));
    }
    return seen;
}

struct Way
{
    std::string transport;
    bool shared_memory;
    Schedule schedule;
    bool client_can;  ///< it is no client of protocol 1.0
};

bool same_bits(Span<double const> a, std::vector<double> const& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), b.size() * sizeof(double)) == 0;
}

class SparseRun : public testing::TestWithParam<Way>
{
};

TEST_P(SparseRun, GivesEveryCellItsNumbersAndTheOthersNone)
{
    Way const way = GetParam();
    Server server(server_options(way.transport == "ipc" ? unused_ipc_endpoint() : any_tcp_endpoint()));
    auto served = in_background([&] { return serve(server, way.schedule); });
    ClientOptions options = client_options(server.endpoint());
    options.shared_memory = way.shared_memory;
    options.encodings = {way.client_can, false, false};
    Client client(options);
    EXPECT_EQ(client.connect({1.2, 1.8e-5}).encodings.sparse, way.client_can);
    client.send_mesh(view_of(mesh()));
    double const before = client.exchange_times().bytes;
    for (int n = 1; n <= steps; ++n)
    {
        FluidArrays const fluid(cells, n);
        SolidFields const& got = client.begin_step(step(n), fluid.view());
        SolidArrays const expected = solid(way.schedule == Schedule::serial ? n : n - 1);
        EXPECT_TRUE(same_bits(got.void_fraction, expected.void_fraction)) << "step " << n;
        EXPECT_TRUE(same_bits(got.drag_coefficient, expected.drag_coefficient)) << "step " << n;
        EXPECT_TRUE(same_bits(got.drag_momentum, expected.drag_momentum)) << "step " << n;
        client.end_step();
    }
    double const bytes = (client.exchange_times().bytes - before) / steps;
    client.finish("done");

    Seen const seen = served.get();
    ASSERT_EQ(seen.velocities.size(), static_cast<std::size_t>(steps));
    EXPECT_EQ(seen.incomplete, way.client_can ? steps : 0);
    EXPECT_EQ(seen.completed, way.schedule == Schedule::serial ? steps / 3 : 0);
    for (int n = 1; n <= steps; ++n)
    {
        bool const whole = !way.client_can || (n % 3 == 0 && way.schedule == Schedule::serial);
        FluidArrays const fluid(cells, n);
        std::vector<double> expected(3 * cells, 0.0);
        CellRuns const sent = whole ? CellRuns{{0, static_cast<std::int32_t>(cells)}} : bed(n - 1);
        for (CellRun const& run : sent)
            std::copy_n(fluid.velocity.begin() + 3 * run.first, 3 * run.count, expected.begin() + 3 * run.first);
        EXPECT_EQ(seen.velocities[static_cast<std::size_t>(n - 1)], expected) << "step " << n;
    }
    double constexpr whole_bytes = (6 + 5) * 8.0 * cells;
    if (!way.client_can)
    {
        EXPECT_GT(bytes, whole_bytes);
    }
    else if (way.schedule == Schedule::overlapped)
    {
        EXPECT_LT(bytes, whole_bytes / 4);  // at most 580 cells and 8 of 11 numbers in each, envelopes of 400 bytes
    }
}

INSTANTIATE_TEST_SUITE_P(
    Ways, SparseRun,
    testing::Values(Way{"ipc", true, Schedule::serial, true}, Way{"ipc", true, Schedule::overlapped, true},
                    Way{"ipc", false, Schedule::serial, true}, Way{"ipc", false, Schedule::overlapped, true},
                    Way{"tcp", false, Schedule::serial, true}, Way{"tcp", false, Schedule::overlapped, true},
                    Way{"ipc", true, Schedule::serial, false}, Way{"tcp", false, Schedule::overlapped, false}),
    [](auto const& way)
    {
        return way.param.transport + (way.param.shared_memory ? "_shared_" : "_frames_") +
               (way.param.schedule == Schedule::serial ? "serial" : "overlapped") +
               (way.param.client_can ? "" : "_old_client");
    });

TEST(SparseSession, AClientOfProtocolOneZeroGetsEveryCell)
{
    Server server(server_options(any_tcp_endpoint()));
    RawPeer peer = RawPeer::client(server.endpoint());
    auto served = in_background([&] { return serve(server, Schedule::overlapped); });
    RawMessage hello = raw_hello();  // tells no encodings
    peer.send(hello);
    auto const welcome = peer.receive();
    ASSERT_TRUE(welcome);
    EXPECT_EQ(welcome->envelope.welcome().encodings_size(), 0);
    peer.send(raw_mesh(mesh()));
    ASSERT_TRUE(peer.receive());
    auto const solid_state = peer.receive();
    ASSERT_TRUE(solid_state && solid_state->envelope.has_solid_state());
    EXPECT_EQ(solid_state->envelope.solid_state().needed_size(), 0);
    EXPECT_TRUE(solid_state->envelope.arrays(0).dense());
    EXPECT_EQ(solid_state->arrays[0].size(), cells * sizeof(double));
    peer.send(raw_goodbye());
    served.get();
}

TEST(SparseSession, AWholeFluidThatIsNotWholeIsRefused)
{
    Server server(server_options(any_tcp_endpoint()));
    RawPeer peer = RawPeer::client(server.endpoint());
    auto served = in_background([&] { return thrown_by([&] { serve(server, Schedule::serial); }); });
    RawMessage hello = raw_hello();
    hello.envelope.mutable_hello()->add_encodings(v1::ENCODING_SPARSE);
    hello.envelope.mutable_hello()->add_encodings(static_cast<v1::Encoding>(99));  // of some later version
    peer.send(hello);
    auto const welcome = peer.receive();
    ASSERT_TRUE(welcome);
    ASSERT_EQ(welcome->envelope.welcome().encodings_size(), 1);
    peer.send(raw_mesh(mesh()));
    ASSERT_TRUE(peer.receive());
    ASSERT_TRUE(peer.receive());
    for (int n = 1; n <= 3; ++n)
    {
        RawMessage fluid = raw_fluid(n, 1e-3 * (n - 1), 1e-3, cells, {{"velocity", 3}, {"pressure_gradient", 3}});
        if (n < 3)
        {
            peer.send(fluid);
            ASSERT_TRUE(peer.receive());
            continue;
        }
        std::size_t const rows = cell_count(bed(2));
        fluid = raw_fluid(3, 2e-3, 1e-3, static_cast<int>(rows), {{"velocity", 3}});
        v1::ArrayHeader& header = *fluid.envelope.mutable_arrays(0);
        header.set_dense(false);
        for (CellRun const& run : bed(2))
        {
            header.add_runs(static_cast<std::uint32_t>(run.first));
            header.add_runs(static_cast<std::uint32_t>(run.count));
        }
        fluid.add("pressure_gradient", v1::ELEMENT_TYPE_F64, 3, std::vector<double>(3 * cells));
        peer.send(fluid);
        auto const wanted = peer.receive();
        ASSERT_TRUE(wanted && wanted->envelope.has_fluid_wanted());
        EXPECT_EQ(wanted->envelope.step(), 3);
        peer.send(fluid);
        EXPECT_THAT(peer.receive_error(), testing::HasSubstr("is not the whole fluid of step 3"));
    }
    EXPECT_THAT(served.get(), testing::StartsWith("protocol: "));
}

}  // namespace
}  // namespace gimdem::test

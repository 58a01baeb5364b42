// SPDX-License-Identifier: BSD-3-Clause
/// What one exchange costs, at the size of the van Wachem bed.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "Pair.hpp"

namespace gimdem::test
{
namespace
{

using namespace coupling;
using Clock = std::chrono::steady_clock;

double constexpr least_bytes = (19.0 + 5.0) * 8 * 26 * 2 * 140;  ///< numbers of both ways [byte]

/// All fluid fields, and the solid fields that a client gets by default.
class BigFields
{
public:
    explicit BigFields(std::size_t cells) : numbers_(9 * cells, 0.5), cells_(cells) {}

    FluidFields fluid() const { return {rows(3), rows(9), rows(3), rows(3), rows(1)}; }
    SolidFields solid() const { return {rows(1), rows(3), rows(1), rows(3)}; }

private:
    Span<double const> rows(std::size_t components) const { return {numbers_.data(), components * cells_}; }

    std::vector<double> numbers_;
    std::size_t cells_;
};

/// Answers at once.
void serve(Server& server)
{
    ServerTerms terms = server_terms();
    terms.needs = {field::velocity, field::velocity_gradient, field::pressure_gradient, field::void_fraction_gradient,
                   field::pressure};
    server.wait_for_client(terms);
    BigFields const fields(static_cast<std::size_t>(server.receive_mesh().cell_count));
    server.accept_mesh(fields.solid());
    while (server.receive_fluid())
        server.send_solid(fields.solid(), {});
}

/// One way for the fields to travel.
struct Way
{
    std::string name;
    std::string endpoint;
    bool shared_memory;
};

struct Cost
{
    std::vector<double> milliseconds;  ///< of each step, sorted
    double bytes = 0;                  ///< of a step
    std::string note;
};

Cost measure(Way const& way, int steps)
{
    Server server(server_options(way.endpoint));
    auto served = in_background([&] { serve(server); });
    Mesh const mesh = BoxMesh::make({26, 2, 140}, {0.15, 0.012, 0.8});
    BigFields const fields(static_cast<std::size_t>(mesh.cell_count));
    ClientOptions options = client_options(server.endpoint());
    options.shared_memory = way.shared_memory;
    Client client(options);
    client.connect({1.28, 1.7e-5});
    client.send_mesh(view_of(mesh));
    double const bytes_before = client.exchange_times().bytes;

    Cost cost;
    for (int n = 1; n <= steps; ++n)
    {
        auto const start = Clock::now();
        client.begin_step(step(n), fields.fluid());
        cost.milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        client.end_step();
    }
    cost.bytes = (client.exchange_times().bytes - bytes_before) / steps;
    cost.note = client.shared_memory_note();
    client.finish("measured");
    served.get();
    std::sort(cost.milliseconds.begin(), cost.milliseconds.end());
    return cost;
}

TEST(RoundTrip, OfTheWachemBedOverEachTransport)
{
    int constexpr steps = 200;
    for (Way const& way : {Way{"shared_memory", unused_ipc_endpoint(), true}, Way{"ipc", unused_ipc_endpoint(), false},
                           Way{"tcp", any_tcp_endpoint(), true}})
    {
        Cost const cost = measure(way, steps);
        double const median = cost.milliseconds[steps / 2];
        char const* const name = way.name.c_str();
        std::printf("figure: round_trip_bytes over %s = %.0f [byte]\n", name, cost.bytes);
        std::printf("figure: round_trip_time_median over %s = %.3f [ms]\n", name, median);
        std::printf("figure: round_trip_time_p95 over %s = %.3f [ms]\n", name, cost.milliseconds[steps * 95 / 100]);
        EXPECT_GT(cost.bytes, least_bytes);
        EXPECT_EQ(cost.note, "");
        EXPECT_LT(median, 1000);  // 1000 times what an idle machine needs: no claim, the figures are
    }
}

}  // namespace
}  // namespace gimdem::test

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

TEST(RoundTrip, OfTheWachemBedTakesAboutAMillisecond)
{
    int constexpr steps = 200;
    Server server(server_options(unused_ipc_endpoint()));
    auto served = in_background([&] { serve(server); });
    Mesh const mesh = BoxMesh::make({26, 2, 140}, {0.15, 0.012, 0.8});
    BigFields const fields(static_cast<std::size_t>(mesh.cell_count));
    Client client(client_options(server.endpoint()));
    client.connect({1.28, 1.7e-5});
    client.send_mesh(view_of(mesh));
    double const bytes_before = client.exchange_times().bytes;

    std::vector<double> milliseconds;
    for (int n = 1; n <= steps; ++n)
    {
        auto const start = Clock::now();
        client.begin_step(step(n), fields.fluid());
        milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        client.end_step();
    }
    double const bytes = (client.exchange_times().bytes - bytes_before) / steps;
    client.finish("measured");
    served.get();

    std::sort(milliseconds.begin(), milliseconds.end());
    double const median = milliseconds[milliseconds.size() / 2];
    std::printf("figure: round_trip_bytes = %.0f [byte]\n", bytes);
    std::printf("figure: round_trip_time_median = %.3f [ms]\n", median);
    std::printf("figure: round_trip_time_p95 = %.3f [ms]\n", milliseconds[milliseconds.size() * 95 / 100]);
    EXPECT_GT(bytes, least_bytes);
    EXPECT_LT(median, 1000);  // 2000 times what an idle machine needs: no claim, the figures are
}

}  // namespace
}  // namespace gimdem::test

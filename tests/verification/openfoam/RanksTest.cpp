// SPDX-License-Identifier: BSD-3-Clause
/// The same fluid on one process and on several.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <tuple>

#include "Endpoint.hpp"
#include "PrescribedParticles.hpp"

namespace gimdem::test
{
namespace
{

using testing::HasSubstr;

/// A box in which everything happens: flow across each cut, a bed whose surface rises, slip walls.
FluidCase box(Vector cuts, bool predictor)
{
    FluidCase fluid;
    fluid.lengths = {0.04, 0.03, 0.08};
    fluid.cells = {4, 3, 8};
    fluid.end_time = 0.0016;
    fluid.time_step = 2e-4;
    fluid.cuts = cuts;
    fluid.momentum_predictor = predictor;
    fluid.correctors = predictor ? 2 : 1;
    fluid.tolerance = 1e-12;
    return fluid;
}

/// Denser on the left, so that the gas flows sideways too; particles that move. The surface passes the centre of a cell
/// in the sixth step, and is never so near one that rounding decides.
Solid bed(Vector x, double t)
{
    if (x[2] > 0.03 + 4.7 * t) return {};
    double const left = 1 - x[0] / 0.04;
    double const void_fraction = 0.5 + 0.1 * x[1] / 0.03 - 0.1 * left;
    double const drag = 2000 * (1 + left);
    return {void_fraction, drag, {0.02 * drag, 0, 0.1 * drag}};
}

/// Cells by their place, rounded to a hundredth of a cell.
std::map<std::tuple<long, long, long>, std::size_t> places(Fluid const& fluid)
{
    std::map<std::tuple<long, long, long>, std::size_t> result;
    for (std::size_t c = 0; c < fluid.centre.size(); ++c)
    {
        auto const rounded = [&](int d) { return std::lround(fluid.centre[c][d] / 1e-4); };
        result.emplace(std::tuple(rounded(0), rounded(1), rounded(2)), c);
    }
    return result;
}

template <std::size_t N>
double largest(std::vector<std::array<double, N>> const& values)
{
    double most = 0;
    for (auto const& row : values)
        for (double const value : row)
            most = std::max(most, std::abs(value));
    return most;
}

template <std::size_t N>
double difference(std::vector<std::array<double, N>> const& a, std::size_t i,
                  std::vector<std::array<double, N>> const& b, std::size_t j)
{
    double most = 0;
    for (std::size_t d = 0; d < N; ++d)
        most = std::max(most, std::abs(a[i][d] - b[j][d]));
    return most;
}

/// The pressure is solved to 1e-12 of its first residual, the velocity, whose matrix is nearly diagonal, to 1e-11. An
/// error of the pressure grows by the condition of the matrix, 1e2 for 8
/// cells in a row, in each of 8 steps: 1e-9 of the largest value.
double constexpr tolerance = 1e-9;

void expect_same(Fluid const& one, Fluid const& many)
{
    ASSERT_EQ(one.mesh.cell_count, many.mesh.cell_count);
    EXPECT_EQ(one.mesh.owner.size(), many.mesh.owner.size());
    EXPECT_EQ(one.mesh.points.size(), many.mesh.points.size());
    EXPECT_EQ(one.time, many.time);
    auto const place = places(many);
    double const pressure = std::abs(*std::max_element(one.pressure.begin(), one.pressure.end(),
                                                       [](double a, double b) { return std::abs(a) < std::abs(b); }));
    for (auto const& [where, i] : places(one))
    {
        ASSERT_TRUE(place.count(where));
        std::size_t const j = place.at(where);
        EXPECT_NEAR(one.volume[i], many.volume[j], 1e-9 * one.volume[i]);  // coordinates in files have 10 digits
        EXPECT_LT(difference(one.velocity, i, many.velocity, j), tolerance * largest(one.velocity));
        EXPECT_NEAR(one.pressure[i], many.pressure[j], tolerance * pressure);
        EXPECT_LT(difference(one.pressure_gradient, i, many.pressure_gradient, j),
                  tolerance * largest(one.pressure_gradient));
        EXPECT_LT(difference(one.velocity_gradient, i, many.velocity_gradient, j),
                  tolerance * largest(one.velocity_gradient));
        EXPECT_LT(difference(one.void_fraction_gradient, i, many.void_fraction_gradient, j),
                  tolerance * largest(one.void_fraction_gradient));
    }
    for (char const* name : {"courant_max", "courant_mean", "velocity_max"})
        EXPECT_NEAR(one.monitors.at(name), many.monitors.at(name), tolerance * std::abs(one.monitors.at(name))) << name;
    EXPECT_LT(many.monitors.at("continuity_error"), 1e-9);
}

TEST(Ranks, TwoSolveTheSameFluidAsOne)
{
    Fluid const one = run_with(box({1, 1, 1}, false), bed);

    ASSERT_GT(largest(one.velocity), 0.9);
    expect_same(one, run_with(box({1, 1, 2}, false), bed));
}

TEST(Ranks, ThreeSolveTheSameFluidAsOneWithAPredictor)
{
    Fluid const one = run_with(box({1, 1, 1}, true), bed);

    expect_same(one, run_with(box({3, 1, 1}, true), bed));
}

/// One rank is killed: all processes end, and the server knows which one.
TEST(Ranks, TheDeathOfOneEndsAll)
{
    FluidCase const fluid = box({2, 1, 1}, false);
    FluidProcess process(fluid);

    try
    {
        run_with(process, 10, bed,
                 [&](Fluid const& now)
                 {
                     if (now.time < 2.5 * fluid.time_step) return;
                     std::string const all = process.log();
                     auto const at = all.rfind("PID    : ");
                     ASSERT_NE(at, std::string::npos);
                     ::kill(static_cast<pid_t>(std::stol(all.substr(at + 9))), SIGKILL);
                 });
        FAIL() << "the run went on";
    }
    catch (std::runtime_error const& error)
    {
        EXPECT_THAT(error.what(), HasSubstr("of 2\""));
    }
    EXPECT_NE(process.wait(), 0);
}

}  // namespace
}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// What the overlapped schedule costs, against the estimate of theory.md (C.11): a cloud and a fluid, which is one body
/// here, come to a common velocity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "CoupledCloud.hpp"
#include "Figure.hpp"
#include "engine/LagMeter.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr double duration = 8e-3;  ///< about the relaxation time of a particle [s]

struct Outcome
{
    std::vector<double> velocity;   ///< of the fluid after each step [m/s]
    std::vector<double> estimated;  ///< |change of velocity by the lag| of each step, by LagMeter [m/s]
};

Outcome relax(bool overlapped, int steps)
{
    CoupledCloud cloud({});
    LagMeter meter(cloud.mesh);
    double const dt = duration / steps;
    double velocity = 1;
    Outcome outcome;
    meter.measure(cloud.engine->fields(), {});
    for (int n = 0; n < steps; ++n)
    {
        double const force_before = cloud.force_on_fluid(velocity);
        cloud.advance({n + 1, n * dt, dt}, velocity);
        double const force_now = cloud.force_on_fluid(velocity);
        LagError const lag = meter.measure(cloud.engine->fields(), cloud.fluid().velocity);
        outcome.estimated.push_back(dt * lag.force * std::abs(force_now) / cloud.fluid_mass());
        velocity += dt * (overlapped ? force_before : force_now) / cloud.fluid_mass();
        outcome.velocity.push_back(velocity);
    }
    return outcome;
}

double largest_difference(std::vector<double> const& a, std::vector<double> const& b)
{
    double largest = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        largest = std::max(largest, std::abs(a[n] - b[n]));
    return largest;
}

TEST(LagError, IsWhatOneStepOfTheOverlappedScheduleDiffersBy)
{
    int constexpr steps = 40;
    double const dt = duration / steps;
    CoupledCloud cloud({});
    LagMeter meter(cloud.mesh);
    double velocity = 1;
    for (int n = 0; n < steps; ++n)
    {
        double const before = cloud.force_on_fluid(velocity);
        cloud.advance({n + 1, n * dt, dt}, velocity);
        double const now = cloud.force_on_fluid(velocity);
        LagError const lag = meter.measure(cloud.engine->fields(), cloud.fluid().velocity);
        double const serial_step = dt * now / cloud.fluid_mass(), overlapped_step = dt * before / cloud.fluid_mass();
        // All particles do the same: the norm over the cells is that of each. They are mapped into eight cells with
        // weights that differ in the last digits.
        if (n > 0)
        {
            EXPECT_NEAR(lag.force * std::abs(serial_step) / std::abs(serial_step - overlapped_step), 1, 1e-6) << n;
        }
        velocity += serial_step;
    }
}

TEST(LagError, AddsUpToNoMoreThanOneStepsLag)
{
    // (C.12): the steps' errors telescope. So the difference of the schedules is of first order, and never more than
    // dt times the range of the force: here that of the first step, which fades.
    std::vector<double> differences;
    for (int const steps : {20, 40, 80})
    {
        Outcome const serial = relax(false, steps), overlapped = relax(true, steps);
        double sum = 0;
        for (double const estimate : serial.estimated)
            sum += estimate;
        differences.push_back(largest_difference(serial.velocity, overlapped.velocity));
        figure("lag_difference_" + std::to_string(steps) + "_steps", differences.back(), "m/s");
        figure("lag_estimate_" + std::to_string(steps) + "_steps", sum, "m/s");
        // The force falls all the time, so that its changes have one sign and the estimates add up to the telescoped
        // sum; the feedback on the fluid is of the next order, dt over the relaxation time of 0.4 to 0.1.
        EXPECT_NEAR(differences.back() / sum, 1, 6.0 / steps);
    }
    // First order: half as much for half the step, with errors of the next order.
    EXPECT_NEAR(differences[0] / differences[1], 2, 0.3);
    EXPECT_NEAR(differences[1] / differences[2], 2, 0.15);
}

}  // namespace

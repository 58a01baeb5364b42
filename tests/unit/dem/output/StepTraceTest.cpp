// SPDX-License-Identifier: BSD-3-Clause
/// The trace: slices in order, sums as reported, and a file that can be read whenever it is cut.
#include "output/StepTrace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <regex>

#include "Files.hpp"
#include "output/SpeedMeter.hpp"

namespace gimdem::output
{
namespace
{

using coupling::ClientTimes;
using coupling::ClockOffset;
using coupling::ServerTimes;
using coupling::Timings;

double constexpr rounding = 1e-12;  ///< of sums of times of some seconds [s]

/// Names and lengths; fails if one begins before its predecessor ends.
std::vector<std::pair<std::string, double>> in_order(std::vector<Slice> const& slices, double from, double to)
{
    std::vector<std::pair<std::string, double>> lengths;
    double last = from;
    for (Slice const& slice : slices)
    {
        EXPECT_GE(slice.from, last - rounding) << slice.name;
        EXPECT_GT(slice.to, slice.from) << slice.name;
        last = slice.to;
        lengths.emplace_back(slice.name, std::round(1e6 * (slice.to - slice.from)) / 1e6);
    }
    EXPECT_LE(last, to + rounding);
    return lengths;
}

using Lengths = std::vector<std::pair<std::string, double>>;

TEST(ServerSlices, AreTheStationsOfAStep)
{
    ServerTimes const times{.asked = 1, .arrived = 1.5, .handed_out = 1.6, .answering = 3, .answered = 3.25};
    ServerStep const step{7, times, 1.8, {.compute = 0.7, .mapping = 0.4, .output = 0.1}, 3.5};
    Lengths const expected{{"waiting", 0.5}, {"exchange", 0.1},  {"output", 0.1},  {"DEM", 0.7},
                           {"mapping", 0.4}, {"exchange", 0.25}, {"records", 0.25}};
    EXPECT_EQ(in_order(slices_of(step), 1, 3.5), expected);
}

TEST(ServerSlices, OfAFluidThatWasThereBeforeHaveNoWaiting)
{
    ServerTimes const times{.asked = 1, .arrived = 0.5, .handed_out = 1.25, .answering = 2, .answered = 2.5};
    Lengths const expected{{"exchange", 0.25}, {"DEM", 0.5}, {"exchange", 0.5}};
    EXPECT_EQ(in_order(slices_of({1, times, 1.25, {.compute = 0.5}, 2.5}), 1, 2.5), expected);
}

TEST(ClientSlices, OfASerialStepWaitBeforeTheFluid)
{
    ClientTimes const times{1, 10, 14, 19, 19.5, 11, 13.5};
    Lengths const expected{{"exchange", 1}, {"waiting", 2.5}, {"exchange", 0.5},
                           {"CFD", 3},      {"output", 1},    {"exchange", 0.5}};
    EXPECT_EQ(in_order(slices_of(times, {.compute = 3, .output = 1}, {100, 0.5}), 10 - 100, 19.5 - 100), expected);
}

TEST(ClientSlices, OfAnOverlappedStepWaitAfterTheFluid)
{
    ClientTimes const times{1, 10, 10.5, 15, 18, 15, 17};
    Lengths const expected{{"exchange", 0.5}, {"CFD", 4}, {"waiting", 2}, {"exchange", 1}};
    EXPECT_EQ(in_order(slices_of(times, {.compute = 4}, {}), 10, 18), expected);
}

TEST(ClientSlices, TakeAllTimeBetweenTheCallsIfNoTimingsAreTold)
{
    ClientTimes const times{1, 10, 10.5, 15, 15, 10, 10};
    Lengths const expected{{"exchange", 0.5}, {"CFD", 4.5}};
    EXPECT_EQ(in_order(slices_of(times, {}, {}), 10, 15), expected);
    // Timings of more than there was are cut, so that slices never overlap.
    EXPECT_EQ(in_order(slices_of(times, {.compute = 4, .output = 9}, {}), 10, 15),
              (Lengths{{"exchange", 0.5}, {"CFD", 4}, {"output", 0.5}}));
}

/// As many complete events as a file holds; its last bracket may be absent, every line but that must be an object.
int events_in(std::string const& text)
{
    EXPECT_EQ(text.substr(0, 2), "[\n");
    int events = 0;
    std::istringstream lines(text.substr(2));
    std::regex const object(R"(\{"ph":"[MXC]",.*\}\}(,?))");
    std::smatch match;
    bool more = true;
    for (std::string line; std::getline(lines, line) && line != "]"; ++events)
    {
        EXPECT_TRUE(more) << "a line without a comma before: " << line;
        EXPECT_TRUE(std::regex_match(line, match, object)) << line;
        more = match.length(1) > 0;
    }
    EXPECT_FALSE(more) << "a comma at the end";
    return events;
}

ServerStep server_step(std::int64_t number)
{
    double const start = 100 + static_cast<double>(number);
    return {number, {start, start + 0.1, start + 0.2, start + 0.7, start + 0.8}, start + 0.3, {0.2, 0.1, 0}, start + 1};
}

TEST(StepTraceFile, CanBeReadWhileTheRunGoesOnAndAtItsEnd)
{
    test::Folder const folder;
    auto const file = folder / "trace.json";
    std::optional<StepTrace> trace(std::in_place, file, 100, TraceChoice{10, 1}, "a \"client\"");
    EXPECT_EQ(events_in(test::read_text(file)), 4) << "two names and their order";
    trace->add(server_step(1), {{"void_fraction_min", 0.4}, {"courant_max", NAN}});
    int const with_one = 4 + 1 + 6 + 1;
    EXPECT_EQ(events_in(test::read_text(file)), with_one) << "a step, its slices, and the counter that is a number";
    EXPECT_THAT(test::read_text(file), testing::Not(testing::HasSubstr("]")));
    trace->add(ClientTimes{1, 110, 110.5, 115, 115, 110, 110}, {}, ClockOffset{9, 0.1});
    EXPECT_GT(trace->cost(), 0);
    trace.reset();
    std::string const text = test::read_text(file);
    EXPECT_EQ(events_in(text), with_one + 3);
    EXPECT_EQ(text.substr(text.size() - 3), "\n]\n");
    EXPECT_THAT(text, testing::HasSubstr(R"({"ph":"X","name":"CFD","pid":2,"tid":2,"ts":1500000.000,"dur":4500000.000,)"
                                         R"("args":{"step":1}})"));
    EXPECT_THAT(text, testing::HasSubstr(R"("name":"client a \"client\"")"));
}

TEST(StepTraceFile, HoldsSoManyStepsAndNoMore)
{
    test::Folder const folder;
    StepTrace trace(folder / "trace.json", 100, {3, 5}, "client");
    std::vector<std::int64_t> wanted;
    for (std::int64_t step = 0; step < 100; ++step)
    {
        if (trace.wants(step)) wanted.push_back(step);
        trace.add(server_step(step), {});
    }
    EXPECT_EQ(wanted, (std::vector<std::int64_t>{1, 6, 11}));
    EXPECT_EQ(events_in(test::read_text(folder / "trace.json")), 4 + 3 * 7);
}

TEST(StepTraceFile, CountsFromTheFirstStepOfARestartedRun)
{
    test::Folder const folder;
    StepTrace trace(folder / "trace.json", 100, {2, 5}, "client");
    std::vector<std::int64_t> wanted;
    for (std::int64_t step = 3001; step < 3100; ++step)
    {
        if (trace.wants(step)) wanted.push_back(step);
        trace.add(server_step(step), {});
    }
    EXPECT_EQ(wanted, (std::vector<std::int64_t>{3001, 3006}));
    EXPECT_FALSE(trace.wants(3000));
}

TEST(StepTraceFile, EndsOnAFullDiskAndTheRunGoesOn)
{
    test::Folder const folder;
    StepTrace trace(folder / "trace.json", 100, {1000, 1}, "client");
    test::FullDisk const full(4096);
    for (std::int64_t step = 1; step <= 100; ++step)
        trace.add(server_step(step), {});
    EXPECT_LE(std::filesystem::file_size(folder / "trace.json"), 4096u);
}

TEST(StepTraceFile, ThatCannotBeMadeIsRefused)
{
    EXPECT_THROW(StepTrace("/nonexistent/trace.json", 0, {1, 1}, "client"), UserError);
}

TEST(SpeedMeter, TellsTheMeanOfTheLastHalfMinute)
{
    SpeedMeter meter;
    EXPECT_TRUE(std::isnan(meter.steps_per_second()));
    meter.add(1000, 0.001);
    EXPECT_TRUE(std::isnan(meter.wall_per_simulated())) << "one step is no speed";
    meter.add(1002, 0.003);
    EXPECT_NEAR(meter.steps_per_second(), 0.5, 1e-12);
    EXPECT_NEAR(meter.wall_per_simulated(), 1000, 1e-6);
    // Ten times as fast from here on: a minute later the slow start is forgotten.
    for (int k = 1; k <= 12000; ++k)
        meter.add(1002 + 0.005 * k, 0.003 + 5e-5 * k);
    EXPECT_NEAR(meter.steps_per_second(), 200, 1e-6);
    EXPECT_NEAR(meter.wall_per_simulated(), 100, 1e-6);
}

}  // namespace
}  // namespace gimdem::output

// SPDX-License-Identifier: BSD-3-Clause
#include "app/CouplingLog.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "CoupledCloud.hpp"
#include "Figures.hpp"
#include "Files.hpp"

namespace gimdem::test
{
namespace
{

using app::CouplingLog;
using coupling::Schedule;

/// Rows of a CSV file by the names of their columns, without units.
std::vector<std::map<std::string, double>> rows_of(std::filesystem::path const& file)
{
    std::istringstream text(read_text(file));
    auto const words = [](std::string const& line)
    {
        std::vector<std::string> all;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            all.push_back(cell);
        return all;
    };
    std::string line;
    std::getline(text, line);
    std::vector<std::string> const names = words(line);
    std::vector<std::map<std::string, double>> rows;
    while (std::getline(text, line))
    {
        std::vector<std::string> const values = words(line);
        auto& row = rows.emplace_back();
        for (std::size_t k = 0; k < names.size(); ++k)
            row[names[k].substr(0, names[k].find(' '))] = std::strtod(values.at(k).c_str(), nullptr);
    }
    return rows;
}

/// Times that are sums of few powers of two, so that sums of them are exact.
struct CouplingLogOf : testing::Test
{
    static constexpr double dt = 0.0009765625;

    coupling::FluidState fluid(std::int64_t step, int pass = 0)
    {
        coupling::FluidState state;
        state.step = {step, dt * static_cast<double>(step - 1), dt};
        state.pass = pass;
        state.fields = cloud.fluid();
        return state;
    }
    /// What the client tells with the first fluid of a step of the one before.
    coupling::FluidState telling(std::int64_t step, coupling::Timings const& previous, double waiting, double exchange,
                                 double residual)
    {
        coupling::FluidState state = fluid(step);
        state.previous = previous;
        state.waiting = waiting;
        state.exchange = exchange;
        state.residual = residual;
        return state;
    }
    StepReport took(std::int64_t dem_steps, coupling::Timings const& timings, bool fluid_was_wanted = false)
    {
        StepReport report;
        report.dem_steps = dem_steps;
        report.timings = timings;
        report.fluid_was_wanted = fluid_was_wanted;
        return report;
    }
    /// One step in one pass, the second in three, the beginning of a third.
    void run(CouplingLog& log)
    {
        log.arrived(fluid(1), 8, 100);
        log.answered(fluid(1), took(10, {1, 0.5, 0.25}, true), *cloud.engine);
        log.arrived(telling(2, {3, 64, 1}, 2, 0.5, 0.125), 0.25, 700);
        cloud.advance({1, 0, 1e-3}, 1);
        log.answered(fluid(2), took(10, {1, 1, 1}), *cloud.engine);
        log.came_again(0.5);
        log.answered(fluid(2, 1), took(20, {1, 0, 0}), *cloud.engine);
        log.came_again(0.25);
        log.answered(fluid(2, 2), took(20, {0.5, 0.25, 0}), *cloud.engine);
        log.arrived(telling(3, {2, 64, 0}, 2.5, 0.75, 0.0625), 1, 1000);
    }

    CoupledCloud cloud{{}};
    Folder folder;
};

TEST_F(CouplingLogOf, ARunWritesARowForEachStepThatIsOver)
{
    cloud.set_fluid(1, 0);
    CouplingLog log(folder.path(), cloud.mesh, Schedule::iterated);
    run(log);

    auto const rows = rows_of(folder / "coupling.csv");
    ASSERT_EQ(rows.size(), 2u);
    auto const expect = [&](std::size_t row, std::map<std::string, double> const& values)
    {
        for (auto const& [name, value] : values)
            EXPECT_EQ(rows[row].at(name), value) << name << " of step " << row + 1;
    };
    expect(0, {{"step", 1},
               {"time", 0},
               {"dt", dt},
               {"dem_steps", 10},
               {"dem", 1.75},
               {"cfd", 4},
               {"server_waiting", 0.25},
               {"client_waiting", 2},
               {"exchange", 0.5},
               {"exchange_bytes", 600},
               {"lag_force", 0},
               {"lag_solid_fraction", 0},
               {"passes", 1},
               {"residual", 0.125}});
    expect(1, {{"step", 2},
               {"time", dt},
               {"dt", dt},
               {"dem_steps", 20},
               {"dem", 4.75},
               {"cfd", 2},
               {"server_waiting", 1.75},
               {"client_waiting", 0.5},
               {"exchange", 0.25},
               {"exchange_bytes", 300},
               {"passes", 3},
               {"residual", 0.0625}});
    EXPECT_GT(rows[1].at("lag_force"), 0) << "of the first pass: the solid of later ones is close to it";
}

TEST_F(CouplingLogOf, ARunEndsWithItsSums)
{
    cloud.set_fluid(1, 0);
    CouplingLog log(folder.path(), cloud.mesh, Schedule::iterated);
    run(log);

    output::Summary summary;
    log.add_to(summary);
    EXPECT_EQ(value_of(summary, "server_waiting"), 2);
    EXPECT_EQ(value_of(summary, "client_waiting"), 2.5);
    EXPECT_EQ(value_of(summary, "exchange_per_step"), 0.375);
    EXPECT_EQ(value_of(summary, "whole_fluids_asked_for"), 1);
    EXPECT_EQ(value_of(summary, "passes_per_step"), 2);
    EXPECT_EQ(value_of(summary, "passes_most"), 3);
    EXPECT_EQ(value_of(summary, "residual_worst"), 0.125);
    double const worst = rows_of(folder / "coupling.csv")[1].at("lag_force");
    EXPECT_NEAR(value_of(summary, "lag_force_worst") / worst, 1, 1e-6) << "to the digits of the file";
    EXPECT_EQ(value_of(summary, "lag_force"), value_of(summary, "lag_force_worst") / 2) << "0 in a step as long";
}

TEST_F(CouplingLogOf, OtherSchedulesTellOfNoPasses)
{
    CouplingLog log(folder.path(), cloud.mesh, Schedule::serial);
    cloud.set_fluid(0, 0);
    run(log);

    output::Summary summary;
    log.add_to(summary);
    EXPECT_EQ(value_of(summary, "server_waiting"), 2);
    EXPECT_TRUE(std::isnan(value_of(summary, "passes_per_step")));
}

TEST_F(CouplingLogOf, ARunThatGoesBackWritesItsRowsAgain)
{
    cloud.set_fluid(1, 0);
    CouplingLog log(folder.path(), cloud.mesh, Schedule::serial);
    run(log);

    log.rewind(dt);
    log.arrived(fluid(2), 4, 1100);
    EXPECT_EQ(rows_of(folder / "coupling.csv").size(), 1u) << "the step that was cut off is not told";
    log.answered(fluid(2), took(10, {1, 1, 1}), *cloud.engine);
    log.arrived(telling(3, {2, 0, 0}, 0.5, 0.25, 0), 1, 1200);

    auto const rows = rows_of(folder / "coupling.csv");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1].at("step"), 2);
    EXPECT_EQ(rows[1].at("exchange_bytes"), 100);
}

}  // namespace
}  // namespace gimdem::test

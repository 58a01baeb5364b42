// SPDX-License-Identifier: BSD-3-Clause
/// What checkpoints bring back, and what becomes of the files. CheckpointRefusalTest.cpp: which files are refused.
#include <algorithm>

#include "CheckpointRun.hpp"
#include "StlText.hpp"

namespace
{

using gimdem::Case;
using gimdem::RunPoint;
using namespace gimdem::test;

TEST_F(CheckpointTest, WritingOneChangesNothing)
{
    ShortRun never(serial), writes(serial);
    never.run_to(600);
    for (std::int64_t step : {0, 150, 387, 400})
    {
        writes.run_to(step);
        writes.write(file);
    }
    writes.run_to(600);
    expect_same(never, writes);
    EXPECT_GT(never.system.removed().size(), 0u);
    EXPECT_GT(never.inlets[0].state().inserted, 100);
    EXPECT_GT(never.system.rebuilds(), 50) << "lists older than the checkpoints are no test";
}

TEST_F(CheckpointTest, RestartedRunEndsBitwiseEqualForAnyThreadCount)
{
    ShortRun through(serial), before(serial);
    through.run_to(500);
    for (std::int64_t step : {1, 387})
    {
        before.run_to(step);
        before.write(file);
        for (auto const& execution : {serial, two_threads, three_threads})
        {
            ShortRun after(execution);
            after.read(file);
            expect_same(before, after);
            EXPECT_EQ(after.at.step, step);
            EXPECT_EQ(after.at.time, static_cast<double>(step) * dt);
            if (step == 1) continue;
            after.run_to(500);
            expect_same(through, after);
        }
    }
}

TEST_F(CheckpointTest, MovingWallsComeBack)
{
    TemporaryStl const sheet(floor_soup(0.004, 0.016, 5, 0.0225));
    Case settings = busy_case();
    auto floor = plane_wall({0, 0, 0}, {0, -0.02, 1});
    floor.vibration = {{0, 0, 1}, 2e-4, 60, 0.0};
    auto blade = stl_wall(sheet, true);
    blade.rotation = {{1, 0, 0}, {0, 0.01, 0.0225}, 20};
    auto pipe = tube_wall(1.5e-3, false);
    pipe.point = {0, 0, 0.0225};
    pipe.velocity = {0.2, 0, -0.5};
    settings.wall = {floor, blade, pipe};
    settings.dem.skin = 0.8;  // lists live for some steps

    ShortRun through(serial, settings), before(serial, settings);
    through.run_to(500);
    auto const& walls = before.system.walls();
    // Walls that stand where they were listed are no test.
    for (std::int64_t step = 200; step < 400 && walls.time() == walls.built_time(); ++step)
        before.run_to(step);
    ASSERT_NE(walls.time(), walls.built_time());
    EXPECT_GT(walls.pairs().plane.size(), 15);
    before.write(file);
    for (auto const& execution : {serial, two_threads, three_threads})
    {
        ShortRun after(execution, settings);
        after.read(file);
        expect_same(before, after);
        EXPECT_EQ(after.system.walls().time(), walls.time());
        EXPECT_EQ(after.system.walls().built_time(), walls.built_time());
        auto const rebuilds = after.system.rebuilds();
        after.run_to(500);
        expect_same(through, after);
        EXPECT_EQ(after.system.rebuilds() - rebuilds, through.system.rebuilds() - before.system.rebuilds());
    }

    // Another shape in the same file is another case.
    std::ofstream(sheet.path, std::ios::binary) << ascii_stl(floor_soup(0.004, 0.016, 6, 0.0225));
    EXPECT_NE(refusal(settings), "");
}

TEST_F(CheckpointTest, RollingSpringsAndPeriodicAxesComeBack)
{
    Case settings = busy_case();
    settings.domain.periodic = {false, true, false};
    settings.dem.rolling_friction = "epsd";
    for (auto& contact : settings.contacts)
    {
        contact.rolling_friction = 0.1;
        contact.rolling_damping = 0.3;
    }
    ShortRun through(serial, settings);
    through.run_to(600);
    EXPECT_EQ(through.system.removed().count("through the wall ymin"), 0u);
    auto const springs = rolling_of_pairs(through.system.neighbors());
    EXPECT_TRUE(std::any_of(springs.host().begin(), springs.host().end(), [](auto const& s) { return s.x != 0; }));
    expect_restarts_like(through,
                         [&](ShortRun const& after)
                         {
                             EXPECT_TRUE(same_bits(springs, rolling_of_pairs(after.system.neighbors())));
                             EXPECT_TRUE(same_bits(through.system.walls().pairs().rolling_spring,
                                                   after.system.walls().pairs().rolling_spring));
                         });
}

TEST_F(CheckpointTest, ConstantTorqueAndWallsOfOtherMaterialsComeBack)
{
    Case settings = busy_case();
    settings.dem.rolling_friction = "cdt";
    settings.materials.push_back({"steel", 7800, 2e6, 0.3});
    settings.walls.material = "steel";
    for (char const* other : {"bead", "glass", "steel"})
        settings.contacts.push_back({{other, "steel"}, 0.6, 0.25});
    for (std::size_t k = 0; k < settings.contacts.size(); ++k)
        settings.contacts[k].rolling_friction = 0.05 * static_cast<double>(k + 1);  // of each pair its own
    auto shelf = tube_wall(4e-3, false);
    shelf.point = {0.012, 0, 0.006};
    shelf.material = "glass";
    settings.wall = {shelf};

    ShortRun through(serial, settings);
    through.run_to(600);
    auto const& state = through.system.particles();
    EXPECT_GT(std::count(state.material.host().begin(), state.material.host().end(), 0), 20);
    EXPECT_GT(std::count(state.material.host().begin(), state.material.host().end(), 1), 20);
    expect_restarts_like(through);
    // The torque is that of the law: without it the run ends elsewhere.
    settings.dem.rolling_friction = "none";
    ShortRun without(serial, settings);
    without.run_to(600);
    EXPECT_FALSE(same_bits(state.angular_velocity, without.system.particles().angular_velocity));
}

TEST_F(CheckpointTest, WritingItAgainGivesTheSameBytes)
{
    ShortRun run(serial), again(two_threads);
    run.run_to(200);
    run.write(file);
    std::string const first = bytes();
    again.read(file);
    again.write(file);
    EXPECT_EQ(bytes(), first);
    EXPECT_GT(first.size(), 10000u);
}

TEST_F(CheckpointTest, StateWithoutParticlesComesBack)
{
    ShortRun run(serial);
    std::vector<std::int32_t> const all(static_cast<std::size_t>(run.system.particles().count()), 0);
    run.system.remove(all, {"by hand"});
    run.write(file);
    ShortRun back(serial);
    back.read(file);
    EXPECT_EQ(back.system.particles().count(), 0);
    EXPECT_EQ(back.system.removed().at("by hand").count, 150);
    run.run_to(300);
    back.run_to(300);
    expect_same(run, back);
    EXPECT_GT(back.system.particles().count(), 20);
}

TEST_F(CheckpointTest, UnwritableFolderLeavesTheOldFile)
{
    ShortRun run(serial);
    run.write(file);
    std::string const before = bytes();
    std::filesystem::path const blocked = folder / "checkpoints" / "state.h5" / "inside";
    EXPECT_ANY_THROW(run.write(blocked));
    EXPECT_EQ(bytes(), before);
}

TEST_F(CheckpointTest, OnlyTheThreeNewestAreKept)
{
    RunPoint const points[] = {{5, 0.5}, {9, 0.9}, {20, 2}, {100, 1e1}};
    for (RunPoint const& point : points)
    {
        std::filesystem::create_directories(folder / "checkpoints");
        std::ofstream(gimdem::checkpoint_file(folder, point)) << point.step;
        gimdem::keep_newest_checkpoints(folder);
    }
    EXPECT_FALSE(std::filesystem::exists(gimdem::checkpoint_file(folder, points[0])));
    for (int k : {1, 2, 3})
        EXPECT_TRUE(std::filesystem::exists(gimdem::checkpoint_file(folder, points[k])));
    EXPECT_EQ(gimdem::checkpoint_file(folder, points[3]).filename(), "step_000000100_at_10.h5");
}

TEST_F(CheckpointTest, EndOfTheRunMustBeLater)
{
    gimdem::require_time_left(file, {10, 0.1}, 0.11);
    EXPECT_THROW(gimdem::require_time_left(file, {10, 0.1}, 0.1), gimdem::UserError);
    EXPECT_THROW(gimdem::require_time_left(file, {10, 0.1 - 1e-12}, 0.1), gimdem::UserError) << "rounding";
}

}  // namespace

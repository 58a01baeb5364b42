// SPDX-License-Identifier: BSD-3-Clause
#include "engine/Checkpoint.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "StlText.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "engine/DomainBounds.hpp"
#include "engine/InletFlow.hpp"
#include "engine/StateFile.hpp"
#include "mesh/BoxDomain.hpp"
#include "output/Snapshot.hpp"
#include "search/PairSprings.hpp"

namespace
{

using gimdem::Case;
using gimdem::DemSystem;
using gimdem::RunPoint;
using namespace gimdem::test;

constexpr double dt = 2e-5;
gimdem::exec::Execution const two_threads{gimdem::exec::Backend::openmp, 2};
gimdem::exec::Execution const three_threads{gimdem::exec::Backend::openmp, 3};

/// A case with everything that a checkpoint holds: two materials, friction, an inlet, an open side.
Case busy_case()
{
    Case settings = bead_case();
    settings.title = "busy";
    settings.identity = "busy 1";
    settings.dem.gravity = {1, 0, -9.81};
    settings.dem.time_step = dt;
    settings.materials.push_back({"glass", 2500, 1e6, 0.25});
    settings.contacts.push_back({{"bead", "glass"}, 0.8, 0.4});
    settings.contacts.push_back({{"glass", "glass"}, 0.7, 0.5});
    settings.domain = gimdem::DomainSettings{{{{0, 0, 0}, {0.02, 0.02, 0.03}}}, {"xmax"}, {}};
    gimdem::InletSettings inlet;
    inlet.material = "glass";
    inlet.mass_rate = 0.05;
    inlet.box = {{{0.002, 0.002, 0.024}, {0.018, 0.018, 0.029}}};
    inlet.velocity = {0.2, 0, -0.5};
    inlet.sizes.emplace();
    inlet.sizes->distribution = "uniform";
    inlet.sizes->minimum = 1e-3;
    inlet.sizes->maximum = 1.6e-3;
    settings.inlets = {inlet};
    return settings;
}

/// A run without a fluid, as short as can be.
struct ShortRun
{
    explicit ShortRun(gimdem::exec::Execution execution, Case const& input = busy_case())
        : settings(input),
          materials(settings),
          mesh(gimdem::box_mesh(settings.domain)),
          walls(mesh, {}, 2e-3, settings.wall),
          bounds(settings.domain),
          inlets(gimdem::make_inlets(settings, materials)),
          system(settings, execution, materials, walls,
                 particles_of(random_spheres(150, {0, 0, 0}, {0.02, 0.02, 0.02}, 4e-4, 8e-4)))
    {
        system.prepare();
        system.begin_coupling_step(nullptr);
        system.let_walls_move(true);
    }
    void run_to(std::int64_t step)
    {
        for (; at.step < step; at.time = static_cast<double>(++at.step) * dt)
        {
            gimdem::insert_from(inlets, at.time, system);
            system.step(dt);
            if (at.step % 20 == 0) bounds.remove_leavers(system);
        }
    }
    void write(std::filesystem::path const& file) { gimdem::write_checkpoint(file, settings, at, inlets, system); }
    void read(std::filesystem::path const& file) { at = gimdem::read_checkpoint(file, settings, inlets, system); }

    Case settings;
    gimdem::Materials materials;
    gimdem::PolyMesh mesh;
    gimdem::WallGeometry walls;
    gimdem::DomainBounds bounds;
    std::vector<gimdem::Inlet> inlets;
    DemSystem system;
    RunPoint at;
};

template <class Buffer>
bool same_bits(Buffer const& a, Buffer const& b)
{
    return a.size() == b.size() && std::memcmp(a.host().data(), b.host().data(), a.host().size_bytes()) == 0;
}

void expect_same(ShortRun const& a, ShortRun const& b)
{
    auto const &p = a.system.particles(), &q = b.system.particles();
    EXPECT_TRUE(same_bits(p.id, q.id));
    EXPECT_TRUE(same_bits(p.material, q.material));
    EXPECT_TRUE(same_bits(p.position, q.position));
    EXPECT_TRUE(same_bits(p.velocity, q.velocity));
    EXPECT_TRUE(same_bits(p.angular_velocity, q.angular_velocity));
    EXPECT_TRUE(same_bits(p.force, q.force));
    EXPECT_TRUE(same_bits(p.torque, q.torque));
    EXPECT_EQ(a.system.walls().total_force(), b.system.walls().total_force());
    EXPECT_TRUE(same_bits(a.system.neighbors().second, b.system.neighbors().second));
    EXPECT_TRUE(same_bits(tangential_of_pairs(a.system.neighbors()), tangential_of_pairs(b.system.neighbors())));
    EXPECT_TRUE(same_bits(a.system.walls().pairs().displacement, b.system.walls().pairs().displacement));
    EXPECT_EQ(a.inlets[0].state().inserted, b.inlets[0].state().inserted);
    EXPECT_EQ(a.inlets[0].state().mass, b.inlets[0].state().mass);
    EXPECT_EQ(a.inlets[0].state().random, b.inlets[0].state().random);
    EXPECT_EQ(a.system.next_id(), b.system.next_id());
    ASSERT_EQ(a.system.removed().size(), b.system.removed().size());
    for (auto const& [cause, removed] : a.system.removed())
    {
        EXPECT_EQ(removed.count, b.system.removed().at(cause).count);
        EXPECT_EQ(removed.mass, b.system.removed().at(cause).mass);
    }
}

class CheckpointTest : public testing::Test
{
protected:
    CheckpointTest() { std::filesystem::create_directories(folder); }
    ~CheckpointTest() override { std::filesystem::remove_all(folder); }

    std::string bytes() const
    {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void put(std::string const& content) const { std::ofstream(file, std::ios::binary) << content; }

    /// What is said about the file; the run that reads it must not change.
    std::string refusal(Case const& settings = busy_case()) const
    {
        ShortRun run(serial, settings), untouched(serial, settings);
        try
        {
            run.read(file);
            return "";
        }
        catch (gimdem::UserError const& error)
        {
            expect_same(run, untouched);
            EXPECT_EQ(run.at.step, 0);
            return error.what();
        }
    }

    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("gimdem-checkpoint-" + std::to_string(::getpid()));
    std::filesystem::path file = folder / "checkpoints" / "state.h5";
};

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
    for (auto const& execution : {serial, two_threads})
    {
        ShortRun before(execution, settings), after(execution, settings);
        before.run_to(387);
        before.write(file);
        after.read(file);
        after.run_to(600);
        expect_same(through, after);
        EXPECT_TRUE(same_bits(springs, rolling_of_pairs(after.system.neighbors())));
        EXPECT_TRUE(
            same_bits(through.system.walls().pairs().rolling_spring, after.system.walls().pairs().rolling_spring));
    }
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
    for (auto const& execution : {serial, two_threads})
    {
        ShortRun before(execution, settings), after(execution, settings);
        before.run_to(387);
        before.write(file);
        after.read(file);
        after.run_to(600);
        expect_same(through, after);
    }
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

TEST_F(CheckpointTest, DamagedFilesAreRefused)
{
    EXPECT_NE(refusal().find("cannot be read"), std::string::npos);
    ShortRun run(serial);
    run.run_to(100);
    run.write(file);
    EXPECT_EQ(refusal(), "");
    std::string const good = bytes();
    put(good.substr(0, good.size() / 2));
    EXPECT_NE(refusal().find("is cut short"), std::string::npos);
    std::string flipped = good;
    flipped[flipped.size() / 3] ^= 1;
    put(flipped);
    std::string const message = refusal();
    EXPECT_NE(message.find("is damaged"), std::string::npos) << message;
    EXPECT_NE(message.find("restart from another checkpoint"), std::string::npos) << message;
}

TEST_F(CheckpointTest, OtherVersionsAndKindsAreRefused)
{
    std::filesystem::create_directories(file.parent_path());
    {
        gimdem::output::SnapshotWriter other(file, "checkpoint");
        other.set("checkpoint_version", gimdem::checkpoint_version + 1);
        other.commit();
    }
    EXPECT_NE(refusal().find("has version " + std::to_string(gimdem::checkpoint_version + 1)), std::string::npos)
        << refusal();
    {
        gimdem::output::SnapshotWriter bed(file, "settled bed");
        bed.commit();
    }
    EXPECT_NE(refusal().find("is of the kind \"settled bed\""), std::string::npos);
}

TEST_F(CheckpointTest, AnotherCaseIsRefused)
{
    ShortRun run(serial);
    run.write(file);
    Case other = busy_case();
    other.identity = "busy 2";
    other.title = "other";
    std::string const message = refusal(other);
    EXPECT_NE(message.find("belongs to another case: \"busy\""), std::string::npos) << message;
}

TEST_F(CheckpointTest, ArraysThatDoNotFitAreRefused)
{
    // Whole and unharmed, but with particles of a second material, for a system that has one.
    ShortRun run(serial), untouched(serial), other(serial);
    run.run_to(200);
    run.write(file);
    gimdem::output::SnapshotReader const reader(file, "checkpoint");
    EXPECT_THROW(gimdem::take_state(reader, 1, other.system), gimdem::UserError);
    expect_same(other, untouched);
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

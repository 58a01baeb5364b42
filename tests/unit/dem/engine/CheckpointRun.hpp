// SPDX-License-Identifier: BSD-3-Clause
/// A short run with everything that a checkpoint holds, and a folder for its checkpoints.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "SameBits.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "engine/Checkpoint.hpp"
#include "engine/DomainBounds.hpp"
#include "engine/InletFlow.hpp"
#include "mesh/BoxDomain.hpp"
#include "search/PairSprings.hpp"

namespace gimdem::test
{

inline constexpr double dt = 2e-5;
inline exec::Execution const two_threads{exec::Backend::openmp, 2};
inline exec::Execution const three_threads{exec::Backend::openmp, 3};

/// A case with everything that a checkpoint holds: two materials, friction, an inlet, an open side.
inline Case busy_case()
{
    Case settings = bead_case();
    settings.title = "busy";
    settings.identity = "busy 1";
    settings.dem.gravity = {1, 0, -9.81};
    settings.dem.time_step = dt;
    settings.materials.push_back({"glass", 2500, 1e6, 0.25});
    settings.contacts.push_back({{"bead", "glass"}, 0.8, 0.4});
    settings.contacts.push_back({{"glass", "glass"}, 0.7, 0.5});
    settings.domain = DomainSettings{{{{0, 0, 0}, {0.02, 0.02, 0.03}}}, {"xmax"}, {}};
    InletSettings inlet;
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
    explicit ShortRun(exec::Execution execution, Case const& input = busy_case())
        : settings(input),
          materials(settings),
          mesh(box_mesh(settings.domain)),
          walls(mesh, {}, 2e-3, settings.wall),
          bounds(settings.domain),
          inlets(make_inlets(settings, materials)),
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
            insert_from(inlets, at.time, system);
            system.step(dt);
            if (at.step % 20 == 0) bounds.remove_leavers(system);
        }
    }
    void write(std::filesystem::path const& file) { write_checkpoint(file, settings, at, inlets, system); }
    void read(std::filesystem::path const& file) { at = read_checkpoint(file, settings, inlets, system); }

    Case settings;
    Materials materials;
    PolyMesh mesh;
    WallGeometry walls;
    DomainBounds bounds;
    std::vector<Inlet> inlets;
    DemSystem system;
    RunPoint at;
};

inline void expect_same(ShortRun const& a, ShortRun const& b)
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
        catch (UserError const& error)
        {
            expect_same(run, untouched);
            EXPECT_EQ(run.at.step, 0);
            return error.what();
        }
    }

    /// A run of the same case that is stopped at step 387 ends as `through` did at step 600, to the bit. `more`: what
    /// else to expect of it.
    template <class More>
    void expect_restarts_like(ShortRun const& through, More const& more) const
    {
        for (auto const& execution : {serial, two_threads})
        {
            ShortRun before(execution, through.settings), after(execution, through.settings);
            before.run_to(387);
            before.write(file);
            after.read(file);
            after.run_to(600);
            expect_same(through, after);
            more(after);
        }
    }
    void expect_restarts_like(ShortRun const& through) const
    {
        expect_restarts_like(through, [](ShortRun const&) {});
    }

    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("gimdem-checkpoint-" + std::to_string(::getpid()));
    std::filesystem::path file = folder / "checkpoints" / "state.h5";
};

}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// A coupled bed of which everything changes within a step: contacts, a moving wall, particles that come and leave. For
/// tests of going back by a step.
#pragma once

#include <bit>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "DeviceScene.hpp"
#include "engine/CoupledEngine.hpp"
#include "engine/InletFlow.hpp"

namespace gimdem::test
{

/// A fluid that differs from cell to cell, as strong as `strength` says.
struct UnevenFluid
{
    UnevenFluid(std::size_t cells, double strength)
    {
        for (std::size_t c = 0; c < cells; ++c)
            for (std::size_t k = 0; k < 9; ++k)
            {
                double const x = strength * std::sin(static_cast<double>(9 * c + k));
                velocity_gradient.push_back(20 * x);
                if (k < 3) velocity.push_back(0.3 * x + (k == 2 ? strength : 0));
                if (k < 3) pressure_gradient.push_back(k == 2 ? -900 * strength : 50 * x);
                if (k < 3) void_gradient.push_back(100 * x);
            }
    }
    coupling::FluidFields fields() const
    {
        coupling::FluidFields f;
        f.velocity = velocity;
        f.velocity_gradient = velocity_gradient;
        f.pressure_gradient = pressure_gradient;
        f.void_fraction_gradient = void_gradient;
        return f;
    }

    std::vector<double> velocity, velocity_gradient, pressure_gradient, void_gradient;
};

struct RewindScene
{
    static constexpr int along = 4;
    static constexpr std::size_t cells = along * along * along;
    static constexpr double height = 0.01;  ///< [m]
    static constexpr double dt = 2e-4;      ///< [s]

    /// 216 spheres that fly up through the open top, rain from above, and a floor that shakes.
    static Case made()
    {
        Case settings = DeviceScene::falling();
        settings.dem.time_step = 2e-5;
        settings.dem.gravity = {0.5, 0.2, 4000};  // the top layer is out within a millisecond
        settings.mapping.void_fraction_minimum = 0.35;
        WallItemSettings floor;
        floor.name = "floor";
        floor.shape = "plane";
        floor.normal = {0, 0, 1};
        floor.vibration = WallVibrationSettings{.direction = {0, 0, 1}, .amplitude = 3e-4, .frequency = 200};
        settings.wall = {floor};
        InletSettings rain;
        rain.material = "bead";
        rain.mass_rate = 0.02;
        rain.box = {{{0.001, 0.001, 0.0005}, {0.009, 0.009, 0.0095}}};
        rain.velocity = {0, 0, -0.5};
        rain.diameter = 4e-4;
        rain.interval = dt / 2;
        settings.inlets = {rain};
        return settings;
    }

    RewindScene(exec::Execution execution, Case const& given)
        : settings(given),
          materials(settings),
          mesh(BoxMesh::make({along, along, along}, {height, height, height})),
          walls(mesh, {"bottom"}, 1.5e-3, settings.wall),
          inlets(make_inlets(settings, materials)),
          system(settings, execution, materials, walls, particles_of(loose_spheres(6, 1.5)))
    {
        system.prepare();
        engine = std::make_unique<CoupledEngine>(settings, execution, mesh, walls,
                                                 coupling::FluidProperties{1.2, 1.8e-5}, system);
        engine->set_inlets(inlets);
        engine->map_initial_state();
    }

    StepReport advance(int number, double strength, double length = dt)
    {
        return engine->advance({number, (number - 1) * dt, length}, UnevenFluid(cells, strength).fields());
    }

    Case settings;
    Materials materials;
    PolyMesh mesh;
    WallGeometry walls;
    std::vector<Inlet> inlets;
    DemSystem system;
    std::unique_ptr<CoupledEngine> engine;
};

inline void expect_same_field(coupling::Span<double const> a, coupling::Span<double const> b, std::string const& name)
{
    ASSERT_EQ(a.size(), b.size()) << name;
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_TRUE(std::bit_cast<std::uint64_t>(a[i]) == std::bit_cast<std::uint64_t>(b[i])) << name << " " << i;
}

/// Particles, contacts, walls, inlets, what left, fields and counts: all to the bit.
inline void expect_same(RewindScene const& a, RewindScene const& b)
{
    expect_same_bits(a.system, b.system);
    EXPECT_TRUE(same_bits(a.system.particles().torque, b.system.particles().torque));
    EXPECT_TRUE(same_bits(a.system.neighbors().second, b.system.neighbors().second));
    EXPECT_EQ(a.system.walls().total_force(), b.system.walls().total_force());
    EXPECT_EQ(a.system.walls().time(), b.system.walls().time());
    EXPECT_EQ(a.system.next_id(), b.system.next_id());
    ASSERT_EQ(a.system.removed().size(), b.system.removed().size());
    for (auto const& [cause, removed] : a.system.removed())
        EXPECT_EQ(removed.count, b.system.removed().at(cause).count) << cause;
    EXPECT_EQ(a.inlets[0].state().inserted, b.inlets[0].state().inserted);
    EXPECT_EQ(a.inlets[0].state().random, b.inlets[0].state().random);
    EXPECT_EQ(a.inlets[0].state().mass, b.inlets[0].state().mass);
    EXPECT_EQ(a.engine->particle_clips(), b.engine->particle_clips());
    auto const f = a.engine->fields(), g = b.engine->fields();
    expect_same_field(f.void_fraction, g.void_fraction, "void fraction");
    expect_same_field(f.momentum_source, g.momentum_source, "momentum source");
    expect_same_field(f.drag_coefficient, g.drag_coefficient, "drag coefficient");
    expect_same_field(f.drag_momentum, g.drag_momentum, "drag momentum");
}

/// A run straight through, and one that goes back twice in each step from passes through other fluids, one of which
/// takes longer, come to the same bits after each step. `remembers`: the first run remembers as well.
inline void expect_passes_leave_no_trace(exec::Execution execution, Case const& settings, bool remembers)
{
    RewindScene straight(execution, settings), repeating(execution, settings);
    std::int64_t removed = 0, removed_in_vain = 0;
    for (int number = 1; number <= 6; ++number)
    {
        if (remembers) straight.engine->remember();
        StepReport const a = straight.advance(number, 1);

        repeating.engine->remember();
        removed_in_vain += repeating.advance(number, 8).removed;
        repeating.engine->go_back();
        removed_in_vain += repeating.advance(number, -3, 2.7 * RewindScene::dt).removed;
        repeating.engine->go_back();
        StepReport const b = repeating.advance(number, 1);

        removed += a.removed;
        EXPECT_EQ(a.removed, b.removed);
        EXPECT_EQ(a.cell_clips, b.cell_clips);
        EXPECT_EQ(a.wall_force.z, b.wall_force.z);
        EXPECT_EQ(a.drag_force.z, b.drag_force.z);
        ASSERT_NO_FATAL_FAILURE(expect_same(straight, repeating)) << "step " << number;
        if (testing::Test::HasFailure()) return;
    }
    // Something happened, and something else in the passes that were given up.
    EXPECT_GT(removed, 10);
    EXPECT_GT(removed_in_vain, removed);
    EXPECT_GT(straight.inlets[0].state().inserted, 5);
    EXPECT_GT(straight.engine->particle_clips(), 0);
}

}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// Fluid loads and mapping on a device against the host.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "DeviceBackends.hpp"
#include "DeviceScene.hpp"
#include "core/Error.hpp"
#include "core/MappingMethodNames.hpp"
#include "engine/CoupledEngine.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

class DeviceFluidTest : public OnDevice
{
};

constexpr int cells_along = 4;
constexpr std::size_t cells = cells_along * cells_along * cells_along;

/// A fluid that differs from cell to cell.
struct Fluid
{
    std::vector<double> velocity, velocity_gradient, pressure_gradient, void_gradient;

    Fluid()
    {
        for (std::size_t c = 0; c < cells; ++c)
            for (std::size_t k = 0; k < 9; ++k)
            {
                double const x = std::sin(static_cast<double>(9 * c + k));
                velocity_gradient.push_back(20 * x);
                if (k < 3) velocity.push_back(0.3 * x + (k == 2 ? 0.8 : 0));
                if (k < 3) pressure_gradient.push_back(k == 2 ? -900 + 30 * x : 50 * x);
                // So steep that some particles see more than 1 or less than the minimum.
                if (k < 3) void_gradient.push_back(150 * x);
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
};

/// 216 spheres in a box of 64 cells, coupled.
struct CoupledScene
{
    CoupledScene(exec::Execution execution, double ratio, Case const& given = made(),
                 std::vector<std::string> const& closed = {"bottom", "top"})
        : settings(given),
          materials(settings),
          mesh(BoxMesh::make({cells_along, cells_along, cells_along}, {0.0126, 0.0126, 0.0126})),
          walls(mesh, closed, 1.5e-3),
          system(settings, execution, materials, walls, particles_of(loose_spheres(6, ratio)))
    {
        system.prepare();
        engine = std::make_unique<CoupledEngine>(settings, execution, mesh, walls,
                                                 coupling::FluidProperties{1.2, 1.8e-5}, system);
        engine->map_initial_state();
    }

    static Case made()
    {
        Case settings = DeviceScene::falling();
        settings.dem.time_step = 2e-5;
        settings.mapping.void_fraction_minimum = 0.35;
        return settings;
    }

    Case settings;
    Materials materials;
    PolyMesh mesh;
    WallGeometry walls;
    DemSystem system;
    std::unique_ptr<CoupledEngine> engine;
};

void expect_near(coupling::Span<double const> a, coupling::Span<double const> b, double tolerance, char const* what)
{
    ASSERT_EQ(a.size(), b.size());
    double largest = 1e-300, difference = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
    {
        largest = std::max(largest, std::abs(a[k]));
        difference = std::max(difference, std::abs(a[k] - b[k]));
    }
    EXPECT_LT(difference / largest, tolerance) << what;
}

void expect_same_solid(CoupledEngine const& host, CoupledEngine const& device, double tolerance)
{
    auto const a = host.fields(), b = device.fields();
    expect_near(a.void_fraction, b.void_fraction, tolerance, "void fraction");
    expect_near(a.momentum_source, b.momentum_source, tolerance, "momentum source");
    expect_near(a.drag_coefficient, b.drag_coefficient, tolerance, "drag coefficient");
    expect_near(a.drag_momentum, b.drag_momentum, tolerance, "drag momentum");
}

// Spheres of one size have tables of the Gaussian integral, those of many sizes the closed form with erfc, whose host
// version is off by 2e-15. The motion adds what DeviceDemTest says.
TEST_P(DeviceFluidTest, CouplesAsTheHostDoes)
{
    Fluid const fluid;
    for (double const ratio : {1.0, 3.0})
    {
        SCOPED_TRACE(ratio);
        CoupledScene host(serial, ratio), there(GetParam(), ratio);
        expect_same_solid(*host.engine, *there.engine, 1e-12);

        for (int step = 1; step <= 3; ++step)
        {
            coupling::Step const over{step, (step - 1) * 2e-4, 2e-4};
            StepReport const a = host.engine->advance(over, fluid.fields());
            StepReport const b = there.engine->advance(over, fluid.fields());

            EXPECT_LT(b.momentum_imbalance, 1e-12);
            EXPECT_LT(b.volume_imbalance, 1e-12);
            EXPECT_EQ(a.cell_clips, b.cell_clips);
            EXPECT_LT((a.drag_force.vec() - b.drag_force.vec()).norm(), 1e-9 * a.drag_force.vec().norm());
            EXPECT_LT((a.pressure_force.vec() - b.pressure_force.vec()).norm(), 1e-9 * a.pressure_force.vec().norm());
            EXPECT_LT((a.wall_force.vec() - b.wall_force.vec()).norm(), 1e-7 * a.wall_force.vec().norm() + 1e-15);
        }

        EXPECT_GT(host.engine->particle_clips(), 0);
        EXPECT_EQ(host.engine->particle_clips(), there.engine->particle_clips());
        expect_same_solid(*host.engine, *there.engine, 1e-9);
        expect_same_within(std::as_const(host.system), std::as_const(there.system), 1e-9);
    }
}

TEST_P(DeviceFluidTest, GivesTheSameBitsInAnyOrder)
{
    Fluid const fluid;
    CoupledScene one(GetParam(), 1), other(in_another_order(), 1);

    one.engine->advance({1, 0, 4e-4}, fluid.fields());
    other.engine->advance({1, 0, 4e-4}, fluid.fields());

    expect_same_bits(std::as_const(one.system), std::as_const(other.system));
    expect_same_solid(*one.engine, *other.engine, 1e-300);
}

TEST_P(DeviceFluidTest, LosesParticlesThroughTheOpenTopAsTheHostDoes)
{
    Fluid const fluid;
    Case settings = CoupledScene::made();
    settings.dem.gravity = {0, 0, 2000};  // up and out within a millisecond
    CoupledScene host(serial, 1, settings, {"bottom"}), there(GetParam(), 1, settings, {"bottom"});
    std::int64_t removed = 0;

    for (int step = 1; step <= 8; ++step)
    {
        coupling::Step const over{step, (step - 1) * 2e-4, 2e-4};
        StepReport const a = host.engine->advance(over, fluid.fields());
        StepReport const b = there.engine->advance(over, fluid.fields());
        EXPECT_EQ(a.removed, b.removed);
        removed += b.removed;
    }

    EXPECT_GT(removed, 20);
    EXPECT_LT(removed, 216);
    // As many contacts as the others: 1e-10, times the roundings of 80 steps at ten times the speed.
    expect_same_solid(*host.engine, *there.engine, 1e-8);
    expect_same_within(std::as_const(host.system), std::as_const(there.system), 1e-8);
}

// The same laws but for the order of sums: roundings of some 1e-14 of a volume for exact, and of the diffusion's solver
// (1e-12 of the fields).
TEST_P(DeviceFluidTest, MapsByEveryMethodAsTheHostDoes)
{
    for (std::string_view const method : mapping_method_names)
    {
        SCOPED_TRACE(method);
        Case settings = CoupledScene::made();
        settings.mapping.method = method;
        settings.mapping.void_fraction_minimum = 0.01;  // no clipping: it would hide differences
        CoupledScene host(serial, 3, settings), there(GetParam(), 3, settings);
        expect_same_solid(*host.engine, *there.engine, 1e-11);
        coupling::Step const over{1, 0, 2e-4};
        Fluid const fluid;
        host.engine->advance(over, fluid.fields());
        StepReport const report = there.engine->advance(over, fluid.fields());
        EXPECT_LT(report.momentum_imbalance, 1e-12);
        EXPECT_LT(report.volume_imbalance, 1e-12);
        expect_same_solid(*host.engine, *there.engine, 1e-9);
    }
}

TEST_P(DeviceFluidTest, RefusesToReuseWeights)
{
    Case settings = CoupledScene::made();
    settings.mapping.reuse_distance = 0.02;
    try
    {
        CoupledScene const scene(GetParam(), 1, settings);
        FAIL() << "a device keeps no weights";
    }
    catch (UserError const& error)
    {
        EXPECT_NE(std::string(error.what()).find("reuse_distance does not work"), std::string::npos) << error.what();
    }
}

TEST_P(DeviceFluidTest, NamesTheParticleThatLeftTheMesh)
{
    CoupledScene scene(GetParam(), 1);
    scene.system.particles().position[7].z = 0.5;
    std::string const number = std::to_string(std::as_const(scene.system).particles().id[7]);
    try
    {
        scene.engine->advance({1, 0, 2e-5}, Fluid().fields());
        FAIL() << "a particle outside the mesh went unnoticed";
    }
    catch (UserError const& error)
    {
        EXPECT_NE(std::string(error.what()).find("particle " + number + " "), std::string::npos) << error.what();
    }
}

GIMDEM_ON_DEVICES(DeviceFluidTest);

}  // namespace

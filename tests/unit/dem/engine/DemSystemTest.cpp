// SPDX-License-Identifier: BSD-3-Clause
#include "SameBits.hpp"
#include "engine/DemSystem.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "engine/CoupledEngine.hpp"
#include "engine/Settling.hpp"
#include "engine/StartChecks.hpp"

namespace
{

using gimdem::Case;
using gimdem::DemSystem;
using gimdem::Vec3;
using namespace gimdem::test;

/// A few hundred spheres that fall, roll and collide in a closed box.
struct Shaker
{
    explicit Shaker(gimdem::exec::Execution execution = serial)
        : settings(bead_case()),
          materials(settings),
          mesh(BoxMesh::make({4, 4, 6}, {0.02, 0.02, 0.03})),
          walls(mesh, {"bottom", "top"}, 2e-3),
          system(make(execution))
    {
    }

    DemSystem make(gimdem::exec::Execution execution)
    {
        settings.dem.gravity = {0, 0, -9.81};
        settings.dem.time_step = 2e-5;
        std::vector<Sphere> spheres;
        for (int k = 0; k < 12; ++k)
            for (int j = 0; j < 6; ++j)
                for (int i = 0; i < 6; ++i)
                {
                    double const radius = 8e-4 + 1e-4 * ((i + j + k) % 5);
                    Vec3 const x = 2.5e-3 * Vec3(i, j, k) + Vec3::Constant(1.5e-3) + 1e-4 * Vec3(j % 3, k % 3, i % 3);
                    spheres.push_back(
                        {x.cwiseMin(Vec3(0.0185, 0.0185, 0.0285)), radius, {0.3 * (k % 2), 0.1, 0}, {5, 0, i * 2.0}});
                }
        return DemSystem(settings, execution, materials, walls, particles_of(spheres));
    }

    void start()
    {
        system.prepare();
        system.begin_coupling_step(nullptr);
    }
    void run(int steps)
    {
        for (int s = 0; s < steps; ++s)
            system.step(2e-5);
    }

    Case settings;
    gimdem::Materials materials;
    gimdem::PolyMesh mesh;
    gimdem::WallGeometry walls;
    DemSystem system;
};

void expect_same_bits(DemSystem const& a, DemSystem const& b)
{
    EXPECT_TRUE(same_bits(a.particles().id, b.particles().id));
    EXPECT_TRUE(same_bits(a.particles().position, b.particles().position));
    EXPECT_TRUE(same_bits(a.particles().velocity, b.particles().velocity));
    EXPECT_TRUE(same_bits(a.particles().angular_velocity, b.particles().angular_velocity));
}

TEST(DemSystem, FreeFallIsExact)
{
    Case settings = bead_case();
    settings.dem.gravity = {0, 0, -9.81};
    gimdem::Materials const materials(settings);
    gimdem::PolyMesh const mesh(BoxMesh::make({1, 1, 1}, {1, 1, 1}));
    gimdem::WallGeometry const walls(mesh, {}, 0.01);
    DemSystem system(settings, serial, materials, walls, particles_of({{{0.5, 0.5, 0.9}, 0.001, {0.1, 0, 0}}}));
    system.prepare();
    system.begin_coupling_step(nullptr);
    for (int s = 0; s < 1000; ++s)
        system.step(1e-4);
    auto const& p = system.particles();
    // Velocity Verlet is exact for a constant force: rounding of 1000 steps.
    EXPECT_NEAR(p.position[0].z, 0.9 - 0.5 * 9.81 * 0.01, 1e-13);
    EXPECT_NEAR(p.velocity[0].z, -0.981, 1e-13);
    EXPECT_NEAR(p.position[0].x, 0.51, 1e-13);
}

TEST(DemSystem, ThreadsDoNotChangeABit)
{
    Shaker one, two({gimdem::exec::Backend::openmp, 2}), three({gimdem::exec::Backend::openmp, 3});
    for (Shaker* s : {&one, &two, &three})
    {
        s->start();
        s->run(600);
    }
    expect_same_bits(one.system, two.system);
    expect_same_bits(one.system, three.system);
    EXPECT_GT(one.system.rebuilds(), 5);
}

TEST(DemSystem, WallsAndGravityAccountForTheChangeOfMomentum)
{
    Shaker shaker;
    shaker.start();
    auto const momentum = [&]
    {
        Vec3 sum = Vec3::Zero();
        for (auto const& v : shaker.system.particles().velocity.host())
            sum += v.xyz() / v.w;
        return sum;
    };
    double mass = 0;
    for (auto const& v : shaker.system.particles().velocity.host())
        mass += 1 / v.w;
    Vec3 const before = momentum();
    shaker.run(1000);
    Vec3 const walls = shaker.system.wall_impulse();
    Vec3 const gravity(0, 0, -9.81 * mass * 1000 * 2e-5);
    EXPECT_GT(walls.norm(), 0.1 * gravity.norm());
    // Particle-particle forces cancel in pairs: rounding of 1000 steps.
    EXPECT_LT((momentum() - before - gravity - walls).norm(), 1e-11 * gravity.norm());
}

TEST(DemSystem, StateOnDiskGoesOnBitForBit)
{
    auto const file = std::filesystem::temp_directory_path() / "gimdem-state-test" / "state.h5";
    Shaker through, restarted;
    through.start();
    through.run(700);
    gimdem::write_state(file, "test", through.system, 0);
    restarted.system.prepare();
    gimdem::read_state(file, "test", restarted.system);
    restarted.system.begin_coupling_step(nullptr);
    through.run(500);
    restarted.run(500);
    expect_same_bits(through.system, restarted.system);
    std::filesystem::remove_all(file.parent_path());
}

TEST(StartChecks, TimeStepAboveAFifthOfTheRayleighTimeIsRefused)
{
    Case settings = bead_case();
    gimdem::Materials const materials(settings);
    auto const particles = particles_of({{{0.5, 0.5, 0.5}, 1.545e-3 / 2}});
    // d = 1.545 mm, rho = 1150, G = 1.2e5 / 2.66: pi r sqrt(rho/G) / (0.1631 nu + 0.8766) by hand.
    EXPECT_NEAR(gimdem::shortest_rayleigh_time(materials, particles), 4.1645e-4, 1e-8);
    settings.dem.time_step = 8.3e-5;
    EXPECT_NO_THROW(gimdem::check_time_step(settings, materials, particles));
    settings.dem.time_step = 8.4e-5;
    EXPECT_THROW(gimdem::check_time_step(settings, materials, particles), gimdem::UserError);
}

TEST(StartChecks, OverlappingParticlesAreNamed)
{
    auto const message = [](double distance) -> std::string
    {
        try
        {
            gimdem::check_overlaps(serial, particles_of({{{0.1, 0, 0}, 0.001}, {{0.1 + distance, 0, 0}, 0.001}}));
            return "";
        }
        catch (gimdem::UserError const& error)
        {
            return error.what();
        }
    };
    EXPECT_EQ(message(0.002), "");
    EXPECT_EQ(message(0.00199), "");
    EXPECT_NE(message(0.0019).find("particles 0 and 1 overlap"), std::string::npos);
}

/// A fluid that is the same everywhere.
struct UniformFluid
{
    explicit UniformFluid(std::int32_t cells, Vec3 const& v, Vec3 const& gradient)
        : zero9(9 * static_cast<std::size_t>(cells)), zero3(3 * static_cast<std::size_t>(cells))
    {
        for (std::int32_t c = 0; c < cells; ++c)
            for (int axis = 0; axis < 3; ++axis)
            {
                velocity.push_back(v[axis]);
                pressure_gradient.push_back(gradient[axis]);
            }
    }
    gimdem::coupling::FluidFields fields() const
    {
        gimdem::coupling::FluidFields f;
        f.velocity = velocity;
        f.pressure_gradient = pressure_gradient;
        f.velocity_gradient = zero9;
        f.void_fraction_gradient = zero3;
        return f;
    }
    std::vector<double> zero9, zero3, velocity, pressure_gradient;
};

TEST(CoupledEngine, SmallSphereInAUniformStreamRelaxesLikeStokes)
{
    Case settings = bead_case();
    settings.dem.time_step = 1e-4;
    gimdem::Materials const materials(settings);
    gimdem::PolyMesh const mesh(BoxMesh::make({3, 3, 3}, {1, 1, 1}));
    gimdem::WallGeometry const walls(mesh, {}, 0.01);
    double const radius = 5e-5;
    DemSystem system(settings, serial, materials, walls, particles_of({{{0.5, 0.5, 0.5}, radius}}));
    system.prepare();
    // Density so low that Re is 1e-9: F = 1 but for 1.5 sqrt of the solid fraction, 5e-12.
    gimdem::coupling::FluidProperties const air{1e-6, 1.8e-5};
    gimdem::CoupledEngine engine(settings, serial, mesh, walls, air, system);
    engine.map_initial_state();
    UniformFluid const stream(27, {0.01, 0, 0}, {0, 0, 0});
    double const tau = 1150 * 4 * radius * radius / (18 * 1.8e-5), dt = 1e-3;
    for (int s = 1; s <= 50; ++s)
    {
        auto const report = engine.advance({s, (s - 1) * dt, dt}, stream.fields());
        EXPECT_EQ(report.dem_steps, 10);
        EXPECT_LT(report.momentum_imbalance, 1e-13);
    }
    // Implicit half kicks: first order in dt_DEM / tau = 0.003; half of it over one relaxation time.
    EXPECT_NEAR(system.particles().velocity[0].x / (0.01 * (1 - std::exp(-0.05 / tau))), 1, 2e-3);
}

TEST(CoupledEngine, StiffDragIsStable)
{
    Case settings = bead_case();
    settings.dem.time_step = 1e-3;
    gimdem::Materials const materials(settings);
    gimdem::PolyMesh const mesh(BoxMesh::make({3, 3, 3}, {1, 1, 1}));
    gimdem::WallGeometry const walls(mesh, {}, 0.01);
    DemSystem system(settings, serial, materials, walls, particles_of({{{0.5, 0.5, 0.5}, 1e-6, {0, 1, 0}}}));
    system.prepare();
    gimdem::CoupledEngine engine(settings, serial, mesh, walls, {1000, 1e-3}, system);
    engine.map_initial_state();
    UniformFluid const stream(27, {0.01, 0, 0}, {0, 0, 0});
    // k dt / m is about 4000 here.
    for (int s = 1; s <= 10; ++s)
        engine.advance({s, (s - 1) * 1e-2, 1e-2}, stream.fields());
    EXPECT_NEAR(system.particles().velocity[0].x, 0.01, 1e-12);
    EXPECT_NEAR(system.particles().velocity[0].y, 0, 1e-12);
}

TEST(CoupledEngine, SemiImplicitSplitGivesBackTheSource)
{
    Case settings = bead_case();
    settings.dem.time_step = 2e-5;
    gimdem::Materials const materials(settings);
    gimdem::PolyMesh const mesh(BoxMesh::make({4, 4, 4}, {0.02, 0.02, 0.02}));
    gimdem::WallGeometry const walls(mesh, {}, 2e-3);
    DemSystem system(settings, serial, materials, walls,
                     particles_of(random_spheres(100, {0, 0, 0}, {0.02, 0.02, 0.02}, 2e-4, 3e-4)));
    system.prepare();
    gimdem::CoupledEngine engine(settings, serial, mesh, walls, {1.2, 1.8e-5}, system);
    engine.map_initial_state();
    UniformFluid const stream(64, {0.3, -0.2, 1.0}, {0, 0, -400});
    auto const report = engine.advance({1, 0, 1e-4}, stream.fields());
    EXPECT_LT(report.momentum_imbalance, 1e-13);
    EXPECT_LT(report.volume_imbalance, 1e-13);
    auto const solid = engine.fields();
    double volume = 0;
    for (std::int64_t p = 0; p < system.particles().count(); ++p)
        volume += system.particles().volume(p);
    EXPECT_NEAR(report.pressure_force.z, 400 * volume, 1e-12 * 400 * volume);
    for (std::size_t c = 0; c < 64; ++c)
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            double const v = stream.velocity[axis];
            double const s = solid.drag_momentum[3 * c + axis] - solid.drag_coefficient[c] * v;
            EXPECT_NEAR(s, solid.momentum_source[3 * c + axis], 1e-12 * solid.drag_coefficient[c] + 1e-300);
            EXPECT_GE(solid.drag_coefficient[c], 0);
        }
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
/// Particles that leave: who is removed, what is counted, and that the others do not notice.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "engine/CoupledEngine.hpp"
#include "engine/DomainBounds.hpp"
#include "mesh/BoxDomain.hpp"

namespace
{

using gimdem::Case;
using gimdem::DemSystem;
using gimdem::Vec3;
using namespace gimdem::test;

gimdem::DomainSettings box(std::vector<std::string> open, std::array<bool, 3> periodic = {})
{
    return {{{{0, 0, 0}, {0.02, 0.03, 0.04}}}, std::move(open), periodic};
}

/// Spheres in a box without a fluid.
struct Boxed
{
    Boxed(std::vector<Sphere> const& spheres, std::vector<std::string> const& open, Vec3 const& gravity = Vec3::Zero(),
          std::array<bool, 3> periodic = {})
        : settings(bead_case()), materials(settings), mesh(gimdem::box_mesh(box(open, periodic))), walls(mesh, {}, 2e-3)
    {
        settings.domain = box(open, periodic);
        settings.dem.gravity = {gravity.x(), gravity.y(), gravity.z()};
        settings.dem.time_step = 2e-5;
        system.emplace(settings, serial, materials, walls, particles_of(spheres));
        system->prepare();
        system->begin_coupling_step(nullptr);
    }
    void run(int steps)
    {
        for (int s = 0; s < steps; ++s)
            system->step(2e-5);
    }
    std::int64_t where(std::int64_t id) const
    {
        for (std::int64_t i = 0; i < system->particles().count(); ++i)
            if (system->particles().id[i] == id) return i;
        return -1;
    }

    Case settings;
    gimdem::Materials materials;
    gimdem::PolyMesh mesh;
    gimdem::WallGeometry walls;
    std::optional<DemSystem> system;
};

TEST(BoxDomain, HasItsVolumeAndSidesWithNormalsOutwards)
{
    gimdem::PolyMesh const mesh(gimdem::box_mesh(box({"zmax"})));
    EXPECT_NEAR(mesh.volume(0), 0.02 * 0.03 * 0.04, 1e-18);
    for (int side = 0; side < 6; ++side)
    {
        Vec3 const outwards = (side % 2 == 0 ? -1 : 1) * Vec3::Unit(side / 2);
        EXPECT_NEAR((mesh.face_normal(side) - outwards).norm(), 0, 1e-15) << gimdem::side_names[side];
    }
    gimdem::WallGeometry const walls(mesh, {}, 1e-3);
    EXPECT_EQ(walls.plane_count(), 5);
}

TEST(DomainBounds, OpenSidesLetGoAndWallsHold)
{
    // One flies out of the open top, one against the wall at xmax.
    Boxed boxed({{{0.01, 0.01, 0.035}, 1e-3, {0, 0, 2}}, {{0.015, 0.01, 0.01}, 1e-3, {2, 0, 0}}}, {"zmax"});
    gimdem::DomainBounds const bounds(box({"zmax"}));
    boxed.run(200);  // 8 mm of the 5 to the top
    EXPECT_EQ(bounds.remove_leavers(*boxed.system), 1);
    ASSERT_EQ(boxed.system->particles().count(), 1);
    EXPECT_EQ(boxed.system->particles().id[0], 1);
    EXPECT_LT(boxed.system->particles().velocity[0].x, -1.7);
    ASSERT_EQ(boxed.system->removed().size(), 1u);
    auto const& [cause, removed] = *boxed.system->removed().begin();
    EXPECT_EQ(cause, "through zmax");
    EXPECT_EQ(removed.count, 1);
    EXPECT_NEAR(removed.mass, 1150 * gimdem::sphere_volume(1e-3), 1e-18);
    EXPECT_EQ(bounds.remove_leavers(*boxed.system), 0);
    EXPECT_EQ(gimdem::lost_particles(*boxed.system), 0) << "it went through an outlet";
    boxed.run(10);
}

TEST(DomainBounds, ParticleBeyondAWallIsCountedAsSuch)
{
    Boxed boxed({{{0.01, 0.01, 0.01}, 1e-3}}, {});
    boxed.system->particles().position[0].x = -1.5e-3;
    EXPECT_EQ(gimdem::DomainBounds(box({})).remove_leavers(*boxed.system), 1);
    EXPECT_EQ(boxed.system->removed().begin()->first, "through the wall xmin");
    EXPECT_EQ(gimdem::lost_particles(*boxed.system), 1);
    EXPECT_EQ(boxed.system->particles().count(), 0);
    boxed.run(10);  // no particles are a case like any other
    boxed.system->insert(particles_of({{{0.01, 0.01, 0.01}, 1e-3}}));
    EXPECT_EQ(boxed.system->particles().id[0], 1) << "ids are never given twice";
    boxed.run(10);
}

TEST(DomainBounds, WhatStartsOutsideOrInAWallIsRefused)
{
    gimdem::DomainBounds const bounds(box({"zmax"}, {false, true, false}));
    auto const message = [&](Vec3 const& x)
    {
        try
        {
            bounds.check_start(particles_of({{{0.01, 0.01, 0.01}, 1e-3}, {x, 1e-3}}));
            return std::string();
        }
        catch (gimdem::UserError const& error)
        {
            return std::string(error.what());
        }
    };
    EXPECT_EQ(message({0.01, 0.01, 0.02}), "");
    EXPECT_EQ(message({0.99e-3, -0.1, 0.0399}), "") << "a little overlap, beyond a periodic side, across an open one";
    EXPECT_NE(
        message({0.97e-3, 0.01, 0.02}).find("particle 1 at (0.00097, 0.01, 0.02) m overlaps the wall xmin by 3e-05"),
        std::string::npos)
        << message({0.97e-3, 0.01, 0.02});
    EXPECT_NE(message({0.01, 0.01, 0.041}).find("is 0.001 m beyond the side zmax"), std::string::npos);
    EXPECT_NE(message({0.021, 0.01, 0.02}).find("is 0.001 m beyond the side xmax"), std::string::npos);
}

TEST(DomainBounds, PeriodicAxisHasNeitherWallNorEnd)
{
    // The same slide along the floor: through the border at xmax, edge of the floor included, and in the middle.
    Vec3 const gravity(0, 0, -9.81);
    auto const sphere = [](double x) { return Sphere{{x, 0.01, 0.999e-3}, 1e-3, {0.5, 0, 0}}; };
    Boxed across({sphere(0.019)}, {}, gravity, {true, false, false}), within({sphere(0.008)}, {}, gravity);
    EXPECT_EQ(across.walls.plane_count(), 4);
    gimdem::DomainBounds const bounds(box({}, {true, false, false}));
    for (int k = 0; k < 30; ++k)
    {
        across.run(10);
        within.run(10);
        EXPECT_EQ(bounds.remove_leavers(*across.system), 0);
    }
    Vec3 const a = across.system->particles().position[0].xyz(), b = within.system->particles().position[0].xyz();
    // 2.9 mm on its way. Forces do not know where along x the sphere is, so all but x is the same to the bit; x is
    // summed up in 300 steps, each rounded to 3.5e-18 m at most (half a unit in the last place of 0.02 m).
    EXPECT_LT(a.x(), 0.005);
    EXPECT_NEAR(a.x() - b.x(), -0.009, 300 * 3.5e-18);
    EXPECT_EQ(a.y(), b.y());
    EXPECT_EQ(a.z(), b.z());
    Vec3 const spin = across.system->particles().angular_velocity[0].xyz();
    EXPECT_EQ(spin, Vec3(within.system->particles().angular_velocity[0].xyz()));
    EXPECT_GT(spin.y(), 1);
}

TEST(DemSystem, ThoseWhoStayKeepTheirSprings)
{
    // Two piles of two, each sliding on the floor; the first pile is taken away.
    std::vector<Sphere> const one{{{0.005, 0.01, 0.99e-3}, 1e-3, {0.05, 0, 0}},
                                  {{0.005, 0.01, 2.96e-3}, 1e-3, {0, 0.05, 0}}};
    std::vector<Sphere> two = one;
    for (Sphere sphere : one)
    {
        sphere.position.x() += 0.01;
        two.push_back(sphere);
    }
    Vec3 const gravity(0, 0, -9.81);
    Boxed alone({two[2], two[3]}, {}, gravity), taken(two, {}, gravity);
    alone.run(40);
    taken.run(40);
    std::vector<std::int32_t> cause(4, -1);
    cause[static_cast<std::size_t>(taken.where(0))] = cause[static_cast<std::size_t>(taken.where(1))] = 0;
    EXPECT_EQ(taken.system->remove(cause, {"by hand"}), 2);
    alone.system->rebuild();  // as remove() does: dashpots see the full-step velocity this once
    alone.run(40);
    taken.run(40);
    for (int k = 0; k < 2; ++k)
    {
        auto const a = alone.where(k), b = taken.where(k + 2);
        ASSERT_GE(b, 0);
        // The same sums in another order, if at all: rounding. A lost spring is a force of 1e-5 N over 0.8 ms: 1e-3
        // m/s.
        EXPECT_NEAR((alone.system->particles().velocity[a].xyz() - taken.system->particles().velocity[b].xyz()).norm(),
                    0, 1e-12);
        EXPECT_NEAR(
            (alone.system->particles().angular_velocity[a].xyz() - taken.system->particles().angular_velocity[b].xyz())
                .norm(),
            0, 1e-9);
    }
    EXPECT_GT(alone.system->particles().angular_velocity[alone.where(0)].xyz().norm(), 1);
}

TEST(DemSystem, NewcomersDoNotDisturbTheOthers)
{
    std::vector<Sphere> const pile{{{0.005, 0.01, 0.99e-3}, 1e-3, {0.05, 0, 0}},
                                   {{0.005, 0.01, 2.96e-3}, 1e-3, {0, 0.05, 0}}};
    Vec3 const gravity(0, 0, -9.81);
    Boxed alone(pile, {}, gravity), joined(pile, {}, gravity);
    alone.run(40);
    joined.run(40);
    joined.system->insert(particles_of({{{0.015, 0.01, 0.01}, 1e-3}, {{0.001, 0.02, 0.03}, 5e-4}}));
    EXPECT_GE(joined.where(3), 0);
    alone.system->rebuild();  // as insert() does
    alone.run(40);
    joined.run(40);
    for (int k = 0; k < 2; ++k)
        EXPECT_NEAR((alone.system->particles().position[alone.where(k)].xyz() -
                     joined.system->particles().position[joined.where(k)].xyz())
                        .norm(),
                    0, 1e-15);
}

/// A sphere that a uniform fluid carries out of the open top of a mesh, another that stays.
TEST(CoupledEngine, ParticleThatLeavesIsMappedALastTimeAndRemoved)
{
    Case settings = bead_case();
    settings.dem.time_step = 1e-4;
    gimdem::Materials const materials(settings);
    gimdem::PolyMesh const mesh(BoxMesh::make({3, 3, 3}, {0.03, 0.03, 0.03}));
    gimdem::WallGeometry const walls(mesh, {}, 2e-3);
    DemSystem system(settings, serial, materials, walls,
                     particles_of({{{0.015, 0.015, 0.0295}, 5e-4, {0, 0, 0.5}}, {{0.015, 0.015, 0.005}, 5e-4}}));
    system.prepare();
    gimdem::CoupledEngine engine(settings, serial, mesh, walls, {1.2, 1.8e-5}, system);
    engine.map_initial_state();
    std::vector<double> const velocity(81, 0.4), zero9(243, 0.0), zero3(81, 0.0);
    gimdem::coupling::FluidFields fluid;
    fluid.velocity = velocity;
    fluid.velocity_gradient = zero9;
    fluid.void_fraction_gradient = fluid.pressure_gradient = zero3;
    std::int64_t removed = 0;
    for (int s = 1; s <= 4; ++s)
    {
        auto const report = engine.advance({s, (s - 1) * 1e-3, 1e-3}, fluid);
        removed += report.removed;
        // All that the drag gave and all volumes are on the mesh, in the step of the removal too: rounding.
        EXPECT_LT(report.momentum_imbalance, 1e-13);
        EXPECT_LT(report.volume_imbalance, 1e-13);
    }
    EXPECT_EQ(removed, 1);
    ASSERT_EQ(system.particles().count(), 1);
    EXPECT_EQ(system.particles().id[0], 1);
    ASSERT_EQ(system.removed().size(), 1u);
    EXPECT_EQ(system.removed().begin()->first, "through top");
}

TEST(CoupledEngine, ParticleThatStartsBeyondAnOpenPatchIsRefused)
{
    Case settings = bead_case();
    gimdem::Materials const materials(settings);
    gimdem::PolyMesh const mesh(BoxMesh::make({3, 3, 3}, {0.03, 0.03, 0.03}));
    gimdem::WallGeometry const walls(mesh, {}, 2e-3);
    DemSystem system(settings, serial, materials, walls, particles_of({{{0.015, 0.015, 0.032}, 5e-4}}));
    system.prepare();
    gimdem::CoupledEngine engine(settings, serial, mesh, walls, {1.2, 1.8e-5}, system);
    EXPECT_THROW(engine.map_initial_state(), gimdem::UserError);
}

TEST(CoupledEngine, InletFeedsACoupledRun)
{
    Case settings = bead_case();
    settings.dem.time_step = 1e-4;
    gimdem::InletSettings inlet;
    inlet.material = "bead";
    inlet.diameter = 1e-3;
    inlet.mass_rate = 0.01;
    inlet.velocity = {0, 0, 1};
    inlet.box = {{{0.005, 0.005, 0.001}, {0.025, 0.025, 0.004}}};
    settings.inlets = {inlet};
    gimdem::Materials const materials(settings);
    gimdem::PolyMesh const mesh(BoxMesh::make({3, 3, 3}, {0.03, 0.03, 0.03}));
    gimdem::WallGeometry const walls(mesh, {"bottom"}, 2e-3);
    DemSystem system(settings, serial, materials, walls, {});
    std::vector<gimdem::Inlet> inlets{gimdem::Inlet(inlet, materials)};
    system.prepare();
    gimdem::CoupledEngine engine(settings, serial, mesh, walls, {1.2, 1.8e-5}, system);
    engine.set_inlets(inlets);
    engine.map_initial_state();
    std::vector<double> const velocity(81, 0.4), zero9(243, 0.0), zero3(81, 0.0);
    gimdem::coupling::FluidFields fluid;
    fluid.velocity = velocity;
    fluid.velocity_gradient = zero9;
    fluid.void_fraction_gradient = fluid.pressure_gradient = zero3;
    for (int s = 1; s <= 60; ++s)
    {
        auto const report = engine.advance({s, (s - 1) * 1e-3, 1e-3}, fluid);
        EXPECT_LT(report.momentum_imbalance, 1e-13);
        EXPECT_LT(report.volume_imbalance, 1e-13);
    }
    // 10 g/s for 59 ms; the first left through the top after some 26 ms. What came is there or was counted (D.67).
    double mass = 0;
    for (std::int64_t p = 0; p < system.particles().count(); ++p)
        mass += system.particles().mass(p);
    auto const& gone = system.removed().at("through top");
    EXPECT_GT(gone.count, 100);
    EXPECT_EQ(system.particles().count() + gone.count, inlets[0].state().inserted);
    EXPECT_NEAR(mass + gone.mass, inlets[0].state().mass, 1e-15);
    EXPECT_NEAR(inlets[0].state().mass, 0.01 * 0.059, 1150 * gimdem::sphere_volume(5e-4));
}

}  // namespace

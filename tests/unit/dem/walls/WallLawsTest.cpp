// SPDX-License-Identifier: BSD-3-Clause
/// Every law and every kind of wall go through one kernel.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <numbers>

#include "StlText.hpp"
#include "WallScene.hpp"

namespace
{

using gimdem::Vec3;
using namespace gimdem::test;

constexpr double radius = 0.03;

gimdem::Case rolling_case(std::vector<gimdem::WallItemSettings> const& walls, std::string const& law)
{
    gimdem::Case settings = WallScene::made(walls, 0, 0.9, 0, 1.2e5);
    settings.dem.rolling_friction = law;
    settings.contacts[0].rolling_friction = 0.1;
    return settings;
}

Vec3 torque_of_walls(WallScene& scene)
{
    scene.system.particles().torque[0] = {0, 0, 0, 0};
    scene.system.walls().add_forces(scene.system.particles(), 1e-9);
    return scene.torque();
}

TEST(RollingFriction, OfATurningDrumGoesByTheRelativeSpin)
{
    double const drum = 0.2, speed = 4, overlap = 1e-4;
    auto tube = tube_wall(drum, true);
    tube.rotation = {{0, 1, 0}, {0, 0, 0}, speed};
    Vec3 const at(0, 0, -(drum - radius + overlap)), spin(0, speed, 0);
    // (D.34): mu_r r times the elastic force, towards the spin of the drum.
    double const full = 0.1 * radius * hertz_wall(radius, overlap);

    // A frictionless contact slips from the first time step on: all torque is that of rolling. 1e-12: rounding.
    WallScene resting(rolling_case({tube}, "cdt"), {{at, radius}});
    EXPECT_LT((torque_of_walls(resting) - Vec3(0, full, 0)).norm(), 1e-12 * full);

    // A sphere that turns with the drum as if welded to it does not roll.
    WallScene welded(rolling_case({tube}, "cdt"), {{at, radius, spin.cross(at), spin}});
    EXPECT_LT(torque_of_walls(welded).norm(), 1e-12 * full);

    tube.rotation.reset();
    WallScene still(rolling_case({tube}, "cdt"), {{at, radius, {0, 0, 0}, spin}});
    EXPECT_LT((torque_of_walls(still) + Vec3(0, full, 0)).norm(), 1e-12 * full);
}

TEST(RollingSpring, GoesAlongFromFacetToFacet)
{
    // Along the outside of a tube of 60 facets: what was wound up about its axis is there beyond the seam.
    double const tube = 0.1, overlap = 1e-4, half = std::numbers::pi / 60;
    TemporaryStl const file(mantle_soup(tube, 0.2, 60, 4));
    WallScene scene(rolling_case({stl_wall(file, true)}, "epsd"), {{{0, 0.1, 0}, radius}});
    auto& particles = scene.system.particles();
    auto& walls = scene.system.walls();
    auto const torque_at = [&](double angle, double spin, double dt)
    {
        double const distance = tube * std::cos(half) + radius - overlap;
        particles.position[0].set_xyz(distance * Vec3(std::cos(angle), 0, std::sin(angle)) + Vec3(0, 0.1, 0));
        particles.angular_velocity[0].set_xyz({0, spin, 0});
        particles.force[0] = particles.torque[0] = {0, 0, 0, 0};
        walls.add_forces(particles, dt);
        return scene.torque().y();
    };
    torque_at(half, 0, 0);
    walls.build(particles, 0.2 * radius, {});
    torque_at(half, 1e-3, 1e-3);
    double const wound = torque_at(half, 0, 0);
    // (D.35), (D.36): 2.25 k_n (mu_r r)^2 times the angle. Corners in float make the overlap uncertain by 3e-5.
    EXPECT_NEAR(wound / (-2.25 * hertz_wall(radius, overlap) / overlap * 9e-6 * 1e-6), 1, 1e-4);
    for (double const angle : {0.5 * half, 0.0, -0.5 * half, -half})
        EXPECT_NEAR(torque_at(angle, 0, 0) / wound, 1, 1e-9) << angle;
}

std::vector<Sphere> crowd(int count)
{
    std::vector<Sphere> spheres;
    for (int k = 0; k < count; ++k)
        spheres.push_back({2.1e-3 * Vec3(k % 8 + 0.5, k / 8 % 8 + 0.5, k / 64 + 0.5) + 1e-4 * Vec3(k % 3, k % 7, k % 5),
                           1e-3, 0.05 * Vec3(k % 5 - 2, k % 3 - 1, k % 4 - 2)});
    return spheres;
}

TEST(AllKindsOfWalls, ThreadsDoNotChangeABit)
{
    TemporaryStl const box(box_soup({0, 0, 0}, {0.018, 0.018, 0.03})), sheet(floor_soup(0.002, 0.016, 12));
    auto shaken = stl_wall(box, false, true);
    shaken.vibration = {{1, 0, 1}, 5e-4, 40, 0};
    auto blade = stl_wall(sheet, true);
    blade.name = "blade";
    blade.rotation = {{1, 0, 0}, {0, 0.009, 0}, 20};
    blade.velocity = {0, 0, 0.5};
    auto tube = tube_wall(0.0125, true);
    tube.point = {0.009, 0, 0.009};
    tube.rotation = {{0, 1, 0}, {0.009, 0, 0.009}, 30};
    gimdem::Case settings =
        WallScene::made({plane_wall({0, 0, 0}, {0, -0.02, 1}), shaken, tube, blade}, 9.81, 0.7, 0.4, 1.2e5);
    settings.dem.rolling_friction = "epsd";
    settings.dem.cohesion = "sjkr";
    settings.contacts[0].rolling_friction = 0.05;
    settings.contacts[0].rolling_damping = 0.3;
    settings.contacts[0].cohesion_energy_density = 100;
    // More than one block of particles.
    auto const spheres = crowd(600);
    using gimdem::exec::Backend;
    WallScene one(settings, spheres);
    one.run(4e-3, 4e-5);
    int touching = 0;
    for (int k = 0; k < 600; ++k)
        touching += one.contacts(k);
    EXPECT_GT(touching, 100);
    EXPECT_GT(one.system.rebuilds(), 3);
    for (int const threads : {2, 3})
    {
        WallScene many(settings, spheres, {Backend::openmp, threads});
        many.run(4e-3, 4e-5);
        auto const a = one.system.particles().position.host(), b = many.system.particles().position.host();
        EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size_bytes()), 0) << threads;
        EXPECT_EQ(one.system.walls().total_force(), many.system.walls().total_force()) << threads;
    }
}

// Planes at rest are told by themselves; those that move, however little, are weeded like any wall.
TEST(PlanesAtRest, DoAsPlanesThatAreWeeded)
{
    std::vector<gimdem::WallItemSettings> box;
    for (int axis = 0; axis < 3; ++axis)
        for (double const side : {0.0, 0.0174})
        {
            gimdem::Triple point{}, normal{};
            point[static_cast<std::size_t>(axis)] = side;
            normal[static_cast<std::size_t>(axis)] = side > 0 ? -1 : 1;
            box.push_back(plane_wall(point, normal));
        }
    auto slow = box;
    for (auto& wall : slow)
        wall.velocity = {0, 0, 1e-200};
    WallScene alone(WallScene::made(box, 9.81, 0.9, 0.3, 1.2e5), crowd(512));
    WallScene weeded(WallScene::made(slow, 9.81, 0.9, 0.3, 1.2e5), crowd(512));
    alone.run(2e-3, 4e-5);
    weeded.run(2e-3, 4e-5);
    // Rounding of 1e-19 m grows a thousandfold in a few collisions.
    for (int k = 0; k < 512; ++k)
        ASSERT_LT((alone.position(k) - weeded.position(k)).norm(), 1e-14) << k;
    Vec3 const force = alone.system.walls().total_force();
    EXPECT_GT(force.norm(), 0.01);
    EXPECT_LT((force - weeded.system.walls().total_force()).norm(), 1e-9 * force.norm());
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
/// Seams of a triangulated wall are not felt.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Figure.hpp"
#include "StlText.hpp"
#include "WallScene.hpp"

namespace
{

using gimdem::Vec3;
using namespace gimdem::test;

constexpr double radius = 0.03;

TEST(RollingSphere, FeelsNoBumpOnATriangulatedPlane)
{
    TemporaryStl const floor(floor_soup(-0.5, 0.5, 60));  // squares of 17 mm: hundreds of seams on the way
    Sphere const ball{{-0.4, -0.35, radius - resting_overlap(radius)}, radius, {0.8, 0.55, 0}, {3, -2, 5}};
    WallScene tiled({stl_wall(floor, true)}, {ball});
    WallScene plane({plane_wall()}, {ball});
    double worst = 0;
    for (int k = 0; k < 20; ++k)
    {
        tiled.run(0.05, 1e-4);
        plane.run(0.05, 1e-4);
        EXPECT_EQ(tiled.contacts(), 1);
        worst = std::max(worst, (tiled.velocity() - plane.velocity()).norm() / plane.velocity().norm());
        // 1e-9 of what has been travelled, of the speed and of the spin.
        EXPECT_LT((tiled.position() - plane.position()).norm(), 1e-9 * (plane.position() - ball.position).norm());
        EXPECT_LT((tiled.velocity() - plane.velocity()).norm(), 1e-9 * plane.velocity().norm());
        EXPECT_LT((tiled.spin() - plane.spin()).norm(), 1e-9 * plane.spin().norm());
    }
    figure("triangulated_plane_bump", worst);
    EXPECT_GT((plane.position() - ball.position).norm(), 0.6);
}

TEST(RollingSphere, FeelsNoBumpOnATiltedTriangulatedPlane)
{
    // Corners in float lie 3e-8 m off the plane: 3e-5 of the resting overlap of 1e-3 m.
    Vec3 const n = Vec3(-0.3, 0.1, 1).normalized();
    Soup tilted = floor_soup(-0.5, 0.5, 40);
    for (Corners& triangle : tilted)
        for (Vec3& x : triangle)
            x.z() = 0.3 * x.x() - 0.1 * x.y();
    TemporaryStl const floor(tilted);
    Sphere const ball{(radius - resting_overlap(radius)) * n + Vec3(0.2, -0.2, 0.08), radius};
    WallScene tiled({stl_wall(floor, true)}, {ball});
    WallScene plane({plane_wall({0, 0, 0}, {n.x(), n.y(), n.z()})}, {ball});
    EXPECT_EQ(tiled.walls.plane_count(), 1);
    tiled.run(0.5, 1e-4);
    plane.run(0.5, 1e-4);
    EXPECT_GT((plane.position() - ball.position).norm(), 0.2);
    EXPECT_LT((tiled.position() - plane.position()).norm(), 1e-6 * (plane.position() - ball.position).norm());
    EXPECT_LT((tiled.spin() - plane.spin()).norm(), 1e-6 * plane.spin().norm());
}

TEST(RollingSphere, InATriangulatedTubeFollowsTheTube)
{
    double const tube = 0.2;
    TemporaryStl const file(mantle_soup(tube, 0.4, 360, 8));
    double const distance = tube - radius + resting_overlap(radius), start = 0.4;
    Sphere const ball{{distance * std::sin(start), 0.2, -distance * std::cos(start)}, radius, {0, 0.05, 0}};
    WallScene facets({stl_wall(file, true)}, {ball}, 9.81, 0.3, 0.5);
    WallScene smooth({tube_wall(tube, true)}, {ball}, 9.81, 0.3, 0.5);
    facets.run(0.6, 1e-4);
    smooth.run(0.6, 1e-4);
    // Facets are up to R (1 - cos(half a degree)) = 7.6e-6 m nearer to the axis, and bend by a degree at the seams: the
    // sphere rocks at each. 1 mm of the way of 0.15 m, 1.5 percent of the spin (half of that was found).
    EXPECT_GT((smooth.position() - ball.position).norm(), 0.1);
    EXPECT_LT((facets.position() - smooth.position()).norm(), 1e-3);
    EXPECT_LT((facets.spin() - smooth.spin()).norm(), 1.5e-2 * smooth.spin().norm());
}

TEST(SpringOfAContact, GoesAlongFromFacetToFacet)
{
    // A sphere dragged along the outside of a tube of 60 facets: what friction holds does not vanish at a seam.
    double const tube = 0.1, overlap = 1e-4;
    TemporaryStl const file(mantle_soup(tube, 0.2, 60, 4));
    double const half = std::numbers::pi / 60, middle = tube * std::cos(half);
    WallScene scene({stl_wall(file, true)}, {{{0, 0.1, 0}, radius}}, 0);
    auto& particles = scene.system.particles();
    auto& walls = scene.system.walls();
    auto const put = [&](double angle)
    {
        Vec3 const at = (middle + radius - overlap) * Vec3(std::cos(angle), 0, std::sin(angle));
        particles.position[0].set_xyz(at + Vec3(0, 0.1, 0));
        particles.force[0] = particles.torque[0] = {0, 0, 0, 0};
    };
    auto const friction = [&] { return scene.wall_force().y(); };

    put(half);
    walls.build(particles, 0.2 * radius, {});
    particles.velocity[0].set_xyz({0, 1e-3, 0});
    walls.add_forces(particles, 1e-3);
    particles.velocity[0].set_xyz({0, 0, 0});
    walls.add_forces(particles, 0);
    double const before = friction();
    EXPECT_LT(before, -1e-6);
    // Over the seam, the corner of two facets: there the overlap is largest; then on to the next facet's middle.
    for (double const angle : {0.5 * half, 0.0, -0.5 * half, -half})
    {
        put(angle);
        walls.add_forces(particles, 0);
        EXPECT_EQ(scene.contacts(), 1);
        EXPECT_LT(friction(), 0.9 * before) << angle;
    }
    EXPECT_NEAR(friction() / before, 1, 1e-9);  // the same overlap, the same spring: along the seams nothing turned
}

}  // namespace

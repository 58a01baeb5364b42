// SPDX-License-Identifier: BSD-3-Clause
/// Planes, tubes and triangles at rest: what a sphere feels where.
#include <gtest/gtest.h>
#include <unistd.h>

#include <numbers>

#include "StlText.hpp"
#include "WallScene.hpp"

namespace
{

using gimdem::Vec3;
using namespace gimdem::test;

constexpr double radius = 0.03, overlap = 0.001;
// Overlaps are differences of numbers 30 times as large: 1.5 * 30 * eps, and some room.
constexpr double rounding = 1e-13;

/// One sphere at rest at x, no gravity; moved by no step.
WallScene at_rest(std::vector<gimdem::WallItemSettings> const& walls, Vec3 const& x)
{
    return WallScene(walls, {{x, radius}}, 0);
}

void expect_force(WallScene const& scene, Vec3 const& expected, int contacts, double tolerance = rounding)
{
    EXPECT_EQ(scene.contacts(), contacts);
    EXPECT_NEAR((scene.wall_force() - expected).norm(), 0, tolerance * std::max(expected.norm(), 1e-6));
}

TEST(InfinitePlane, PushesAlongItsNormalWhereverTheSphereIs)
{
    Vec3 const n = Vec3(1, 2, 2) / 3, along = Vec3(2, -1, 0).normalized();
    for (double const far : {0.0, 5.0, -300.0})
    {
        // On the plane x . n = 3, far along it: coordinates of 300 m keep 13 digits of the overlap less.
        auto const scene = at_rest({plane_wall({1, 2, 2}, {2, 4, 4})}, (3 + radius - overlap) * n + far * along);
        expect_force(scene, hertz_wall(radius, overlap) * n, 1, far == 0 ? 1e-11 : 1e-9);
    }
    EXPECT_EQ(at_rest({plane_wall()}, {0, 0, radius + 1e-9}).contacts(), 0);
}

TEST(Tube, HoldsASphereInside)
{
    Vec3 const radial = Vec3(3, 0, 4) / 5;
    auto const tube = tube_wall(0.1, true);
    expect_force(at_rest({tube}, (0.1 - radius + overlap) * radial + Vec3(0, 7, 0)),
                 -hertz_wall(radius, overlap) * radial, 1, 1e-12);
    EXPECT_EQ(at_rest({tube}, {0, 0, 0}).contacts(), 0);  // on the axis no direction is nearest
    EXPECT_EQ(at_rest({tube}, {0.0699, 0, 0}).contacts(), 0);
}

TEST(Tube, KeepsASphereOut)
{
    Vec3 const radial = Vec3(3, 0, -4) / 5;
    expect_force(at_rest({tube_wall(0.1, false)}, (0.1 + radius - overlap) * radial),
                 hertz_wall(radius, overlap) * radial, 1, 1e-12);
}

TEST(Tube, EndsWhereItsLengthSays)
{
    auto const tube = tube_wall(0.1, true, 0.5);  // from y = 0 to 0.5
    expect_force(at_rest({tube}, {0.071, 0.499, 0}), {-hertz_wall(radius, overlap), 0, 0}, 1, 1e-12);
    // Beyond the end the rim is touched, here at 45 degrees.
    double const step = (radius - overlap) * std::sqrt(0.5);
    expect_force(at_rest({tube}, {0.1 - step, 0.5 + step, 0}),
                 hertz_wall(radius, overlap) * Vec3(-1, 1, 0) * std::sqrt(0.5), 1, 1e-12);
    EXPECT_EQ(at_rest({tube}, {0.071, -0.5, 0}).contacts(), 0);
}

TEST(Triangles, AsciiAndBinaryFilesAreTheSameWall)
{
    Soup const floor = floor_soup(-1, 1, 3);
    TemporaryStl const ascii(ascii_stl(floor)), binary(binary_stl(floor));
    for (auto const* file : {&ascii, &binary})
    {
        auto const scene = at_rest({stl_wall(*file, true)}, {1.0 / 3, 0.1, radius - overlap});
        EXPECT_EQ(scene.walls.triangle_count(), 18);
        EXPECT_EQ(scene.walls.plane_count(), 1);
        expect_force(scene, {0, 0, hertz_wall(radius, overlap)}, 1);
    }
}

TEST(Triangles, ScaleIsMetresPerUnitOfTheFile)
{
    TemporaryStl const millimetres(floor_soup(-1000, 1000, 2, 500));
    auto wall = stl_wall(millimetres, true);
    wall.scale = 0.001;
    expect_force(at_rest({wall}, {0.3, 0.1, 0.5 + radius - overlap}), {0, 0, hertz_wall(radius, overlap)}, 1, 1e-11);
}

TEST(Triangles, SheetPushesOnBothSides)
{
    TemporaryStl const sheet(floor_soup(-1, 1, 2));
    expect_force(at_rest({stl_wall(sheet, true)}, {0.1, 0.2, -(radius - overlap)}),
                 {0, 0, -hertz_wall(radius, overlap)}, 1);
}

TEST(Triangles, HugeOnesAreNotMissedBySmallSpheres)
{
    // One tilted triangle of 100 m, a sphere of 1 mm: 1e5 in size. The grid has boxes far larger than the sphere.
    TemporaryStl const huge(Soup{{Vec3(-64, -64, -32), Vec3(64, -64, -32), Vec3(0, 64, 32)}});
    Vec3 const n = Vec3(0, -0.5, 1).normalized();
    double const small = 1e-3, depth = 1e-4;
    for (Vec3 const& on : {Vec3(0, 0, 0), Vec3(13.7, -31, -15.5), Vec3(-50, -62, -31), Vec3(0, 60, 30)})
    {
        WallScene const scene({stl_wall(huge, true)}, {{on + (small - depth) * n, small}}, 0);
        // 64 m hold 1.4e-14 m: 1.4e-10 of the overlap, 1.5 powers and both ends of the difference.
        expect_force(scene, hertz_wall(small, depth) * n, 1, 1e-9);
        WallScene const beside({stl_wall(huge, true)}, {{on + (small + depth) * n, small}}, 0);
        EXPECT_EQ(beside.contacts(), 0);
    }
}

TEST(Triangles, ClosedBoxPushesTowardsWhereTheParticlesAre)
{
    TemporaryStl const box(box_soup({0, 0, 0}, {1, 1, 1}));
    double const f = hertz_wall(radius, overlap);
    expect_force(at_rest({stl_wall(box, false, true)}, {0.5, 0.4, radius - overlap}), {0, 0, f}, 1);
    expect_force(at_rest({stl_wall(box, false, false)}, {0.5, 0.4, -(radius - overlap)}), {0, 0, -f}, 1);
    // In a corner from inside: three planes, each once.
    expect_force(at_rest({stl_wall(box, false, true)}, Vec3::Constant(radius - overlap)), {f, f, f}, 3);
    EXPECT_EQ(at_rest({stl_wall(box, false, true)}, {0.5, 0.5, 0.5}).walls.plane_count(), 6);
}

TEST(Triangles, EdgeOrCornerFromOutsideIsTouchedOnce)
{
    TemporaryStl const box(box_soup({0, 0, 0}, {1, 1, 1}));
    auto const wall = stl_wall(box, false, false);
    double const f = hertz_wall(radius, overlap), d = radius - overlap;
    expect_force(at_rest({wall}, {0.5, 1 + d * std::sqrt(0.5), 1 + d * std::sqrt(0.5)}),
                 f * std::sqrt(0.5) * Vec3(0, 1, 1), 1, 1e-12);
    expect_force(at_rest({wall}, Vec3::Constant(1 + d * std::sqrt(1.0 / 3))), f * std::sqrt(1.0 / 3) * Vec3(1, 1, 1), 1,
                 1e-12);
    // On the top near its edge: the edge is within reach but belongs to the face that is touched.
    expect_force(at_rest({wall}, {0.5, 0.999, 1 + d}), {0, 0, f}, 1, 1e-12);
    expect_force(at_rest({wall}, {0.999, 0.999, 1 + d}), {0, 0, f}, 1, 1e-12);
}

TEST(Triangles, FineCurvedSurfaceIsTouchedOnceEverywhere)
{
    // A tube of 120 x 40 facets of 5 mm, six times smaller than the sphere: from inside and outside, at many places.
    double const tube = 0.1, length = 0.2;
    TemporaryStl const file(mantle_soup(tube, length, 120, 40));
    // A facet's middle is R (1 - cos(pi / n)) nearer to the axis than its corners.
    double const sag = tube * (1 - std::cos(std::numbers::pi / 120));
    for (bool const inside : {true, false})
    {
        auto sheet = stl_wall(file, true);
        WallScene scene({sheet}, {{{0, 0.1, 0}, radius}}, 0);
        EXPECT_EQ(scene.walls.plane_count(), 120);  // strips along y are flat
        for (int k = 0; k < 200; ++k)
        {
            double const angle = 0.031415 * k, distance = inside ? tube - radius + overlap : tube + radius - overlap;
            Vec3 const radial(std::cos(angle), 0, std::sin(angle));
            auto& x = scene.system.particles().position[0];
            x.set_xyz(distance * radial + Vec3(0, 0.05 + 4.9e-4 * k, 0));
            scene.system.walls().build(scene.system.particles(), 0.2 * radius, {});
            scene.system.walls().add_forces(scene.system.particles(), 0);
            EXPECT_EQ(scene.contacts(), 1) << inside << ' ' << k;
            // Between the forces at the facet's middle and at its edge.
            double const least = hertz_wall(radius, inside ? overlap : overlap - sag) * (1 - 1e-3);
            double const most = hertz_wall(radius, inside ? overlap + 1.5 * sag : overlap) * (1 + 1e-3);
            double const push = scene.wall_force().dot(inside ? Vec3(-radial) : radial);
            EXPECT_GE(push, least) << inside << ' ' << k;
            EXPECT_LE(push, most) << inside << ' ' << k;
        }
    }
}

TEST(Triangles, ManySmallOnesUnderOneSphereAreOneContact)
{
    // A shallow bowl z = (x^2 + y^2) / 2 m of 80 x 80 squares of 2.5 mm, no two squares in one plane: hundreds are
    // near the sphere, more than a kernel holds at hand, and several overlap with it.
    Soup bowl = floor_soup(-0.1, 0.1, 80);
    for (Corners& triangle : bowl)
        for (Vec3& x : triangle)
            x.z() = (x.x() * x.x() + x.y() * x.y()) / 2;
    TemporaryStl const file(bowl);
    auto const scene = at_rest({stl_wall(file, true)}, {0.0012, 0.0007, radius - overlap});
    EXPECT_EQ(scene.walls.plane_count(), 6400);  // the two triangles of a square are in one plane
    EXPECT_GT(scene.system.walls().pairs().plane.size(), 100);
    EXPECT_EQ(scene.contacts(), 1);
    // Chords lie above the bowl, by at most h^2 / 4 = 1.6e-6 m, 2.4e-3 of the force.
    EXPECT_NEAR(scene.wall_force().norm() / hertz_wall(radius, overlap), 1, 5e-3);
}

}  // namespace

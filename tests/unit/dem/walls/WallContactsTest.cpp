// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallContacts.hpp"

#include <gtest/gtest.h>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "WallForce.hpp"
#include "core/Error.hpp"

namespace
{

using gimdem::PolyMesh;
using gimdem::Vec3;
using gimdem::WallGeometry;
using namespace gimdem::test;

double hertz(double radius, double overlap)
{
    double const young_eff = 1.2e5 / (2 * (1 - 0.33 * 0.33));
    return 4.0 / 3.0 * young_eff * std::sqrt(radius) * std::pow(overlap, 1.5);
}

struct Box
{
    PolyMesh mesh{BoxMesh::make({20, 20, 20}, {1, 1, 1})};  // cells of 0.05, spheres of 0.03 in radius
    WallGeometry walls{mesh, {"bottom"}, 0.05};
};

TEST(WallGeometry, CoplanarFacesAreOnePlane)
{
    Box const box;
    EXPECT_EQ(box.walls.plane_count(), 5);  // four sides and the bottom; the top is open
    EXPECT_EQ(box.walls.triangle_count(), 5 * 400 * 4);
    EXPECT_THROW(WallGeometry(box.mesh, {"floor"}, 0.05), gimdem::UserError);
}

TEST(WallContacts, SphereFeelsAPlaneOnceWhereverItTouches)
{
    Box const box;
    double const r = 0.03, overlap = 0.002, expected = hertz(r, overlap);
    // Middle of a face, on a seam, on a corner of four faces, and in between.
    for (Vec3 const& x : {Vec3(0.525, 0.525, 0), Vec3(0.5, 0.525, 0), Vec3(0.5, 0.5, 0), Vec3(0.5 + 1e-12, 0.5, 0),
                          Vec3(0.51, 0.537, 0)})
    {
        auto const f = wall_force(box.walls, x + Vec3(0, 0, r - overlap), r);
        EXPECT_EQ(f.w, 1);
        EXPECT_NEAR(f.z, expected, 1e-12 * expected);
        EXPECT_EQ(f.x, 0);
        EXPECT_EQ(f.y, 0);
    }
}

TEST(WallContacts, SphereInACornerFeelsEachPlaneOnce)
{
    Box const box;
    double const r = 0.03, overlap = 0.002, expected = hertz(r, overlap);
    auto const f = wall_force(box.walls, Vec3::Constant(r - overlap), r);
    EXPECT_EQ(f.w, 3);
    for (double const component : {f.x, f.y, f.z})
        EXPECT_NEAR(component, expected, 1e-12 * expected);
}

TEST(WallContacts, NothingTouchesTheOpenTop)
{
    Box const box;
    EXPECT_EQ(wall_force(box.walls, Vec3(0.5, 0.5, 0.999), 0.03).w, 0);
}

/// A box whose bottom is a wall for x < 0.5 only: a sphere can hang over the rim of the plane.
TEST(WallContacts, RimOfAPlaneIsTouchedByTheNearestPoint)
{
    auto topology = BoxMesh::make({20, 20, 20}, {1, 1, 1});
    for (auto& patch : topology.patches)
    {
        if (patch.name != "bottom") continue;
        // Faces of the bottom run x first: give each row's first half to a patch of its own is not contiguous; keep the
        // first half of the rows (y < 0.5) as the wall instead.
        auto const half = patch.face_count / 2;
        gimdem::coupling::Patch rest = patch;
        patch.face_count = half;
        patch.kind = gimdem::coupling::PatchKind::wall;
        rest.name = "hole";
        rest.start_face += half;
        rest.face_count -= half;
        topology.patches.push_back(rest);
        break;
    }
    PolyMesh const mesh(std::move(topology));
    WallGeometry const walls(mesh, {}, 0.05);
    double const r = 0.03;
    // Centre beyond the rim at y = 0.5, at 45 degrees above it.
    double const distance = r - 0.001;
    Vec3 const x(0.52, 0.5 + distance * std::sqrt(0.5), distance * std::sqrt(0.5));
    auto const f = wall_force(walls, x, r);
    EXPECT_EQ(f.w, 1);
    double const expected = hertz(r, 0.001);
    EXPECT_NEAR(f.y, expected * std::sqrt(0.5), 1e-9 * expected);
    EXPECT_NEAR(f.z, expected * std::sqrt(0.5), 1e-9 * expected);
}

}  // namespace

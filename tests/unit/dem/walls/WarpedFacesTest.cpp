// SPDX-License-Identifier: BSD-3-Clause
/// Wall faces whose points are not in one plane, as on the curved walls of polyhedral meshes: what a sphere feels is
/// the surface of the triangles around each face's centre.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "WallForce.hpp"
#include "WallScene.hpp"

namespace
{

using gimdem::PolyMesh;
using gimdem::Vec3;
using namespace gimdem::test;

constexpr double radius = 0.03;

/// A box whose bottom is bent like a saddle: each of its 16 x 16 faces is warped by 1 % of its width.
PolyMesh saddle()
{
    auto topology = BoxMesh::make({16, 16, 4}, {1, 1, 1});
    for (std::size_t p = 0; p < topology.points.size(); p += 3)
        topology.points[p + 2] += 0.64 * (1 - topology.points[p + 2]) * topology.points[p] * topology.points[p + 1];
    return PolyMesh(std::move(topology));
}

double distance_to_segment(Vec3 const& x, Vec3 const& a, Vec3 const& b)
{
    double const along = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (x - a - along * (b - a)).norm();
}

double distance_to_triangle(Vec3 const& x, std::array<Vec3, 3> const& corners)
{
    Vec3 const normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    bool over = true;
    double nearest = 1e300;
    for (std::size_t k = 0; k < 3; ++k)
    {
        Vec3 const &a = corners[k], &b = corners[(k + 1) % 3];
        over = over && (b - a).cross(x - a).dot(normal) >= 0;
        nearest = std::min(nearest, distance_to_segment(x, a, b));
    }
    return over ? std::abs((x - corners[0]).dot(normal)) : nearest;
}

/// Over all triangles that an edge of a face of the bottom makes with the face's centre.
double distance_to_bottom(PolyMesh const& mesh, Vec3 const& x)
{
    double nearest = 1e300;
    for (auto const& patch : mesh.topology().patches)
        for (std::int32_t f = patch.start_face; patch.name == "bottom" && f < patch.start_face + patch.face_count; ++f)
        {
            auto const points = mesh.points_of_face(f);
            for (std::size_t k = 0; k < points.size(); ++k)
                nearest = std::min(nearest, distance_to_triangle(
                                                x, {mesh.point(points[k]), mesh.point(points[(k + 1) % points.size()]),
                                                    mesh.face_centre(f)}));
        }
    return nearest;
}

TEST(WarpedFaces, AreFeltAtTheNearestPointOfTheirTriangles)
{
    PolyMesh const mesh = saddle();
    gimdem::WallGeometry const walls(mesh, {"bottom"}, 0.05);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> anywhere(0.1, 0.9);
    for (int i = 0; i < 300; ++i)
    {
        double const x = anywhere(random), y = anywhere(random);
        Vec3 const slope = Vec3(-0.64 * y, -0.64 * x, 1).normalized();
        Vec3 const at = Vec3(x, y, 0.64 * x * y) + (radius - 0.002) * slope;
        double const expected = hertz_wall(radius, radius - distance_to_bottom(mesh, at));

        auto const force = wall_force(walls, at, radius);

        // One smooth surface: one contact, also where two triangles are touched. Overlaps keep 13 digits less.
        ASSERT_EQ(force.w, 1) << at.transpose();
        ASSERT_NEAR(force.xyz().norm(), expected, 1e-10 * expected) << at.transpose();
    }
}

}  // namespace

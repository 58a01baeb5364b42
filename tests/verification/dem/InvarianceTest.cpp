// SPDX-License-Identifier: BSD-3-Clause
/// The laws do not know where the scene is, how it is turned, or how fast it flies.
#include <gtest/gtest.h>

#include "Figure.hpp"
#include "WallImpact.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::MaterialSettings;
using gimdem::Vec3;

MaterialSettings const bead{"bead", 1150, 1.2e5, 0.33};

Vec3 const centre = Vec3::Constant(0.1);

/// side^3 spheres of different sizes around the centre of the box; they fall upon each other and rub.
std::vector<Sphere> heap(int side)
{
    auto spheres = random_spheres(side * side * side, {0, 0, 0}, {1, 1, 1}, 0.8e-3, 1.2e-3);
    for (int n = 0; n < side * side * side; ++n)
    {
        Sphere& s = spheres[static_cast<std::size_t>(n)];
        s.position =
            centre + 2.5e-3 * (Vec3(n % side, n / side % side, n / side / side) - Vec3::Constant((side - 1) / 2.0));
        s.velocity -= 80 * (s.position - centre);
    }
    return spheres;
}

/// Two of them, one contact.
std::vector<Sphere> pair()
{
    auto spheres = heap(2);
    spheres.resize(2);
    return spheres;
}

SphereBox scene_of(std::vector<Sphere> const& spheres)
{
    return SphereBox(impact_case(bead, bead, 0.7, 0.4), {{0.2, 0.2, 0.2}, {}}, spheres);
}

/// Largest differences of the spheres of two scenes, b seen by `back` from position and velocity of a's frame.
struct Difference
{
    double position = 0, velocity = 0, spin = 0;
};

template <class Back>
Difference compare(SphereBox const& a, SphereBox const& b, Back const& back)
{
    Difference d;
    for (int i = 0; i < a.particles().count(); ++i)
    {
        auto const [x, v, w] = back(b.position(i), b.velocity(i), b.spin(i));
        d.position = std::max(d.position, (a.position(i) - x).norm() / 1e-3);
        d.velocity = std::max(d.velocity, (a.velocity(i) - v).norm() / 0.2);
        d.spin = std::max(d.spin, (a.spin(i) - w).norm() / 200);
    }
    return d;
}

void print(std::string const& name, Difference const& d)
{
    figure(name + "_position", d.position);
    figure(name + "_velocity", d.velocity);
    figure(name + "_spin", d.spin);
}

void expect_below(Difference const& d, double position_bound, double bound)
{
    EXPECT_LT(d.position, position_bound);
    EXPECT_LT(d.velocity, bound);
    EXPECT_LT(d.spin, bound);
}

/// Difference between a scene and the same turned about an axis that is none of the mesh's, after 1000 steps.
Difference turned(std::vector<Sphere> spheres)
{
    Eigen::Matrix3d const turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
    SphereBox a = scene_of(spheres);
    Vec3 const spin_before = a.spin(0);
    for (Sphere& s : spheres)
    {
        s.position = centre + turn * (s.position - centre);
        s.velocity = turn * s.velocity;
        s.angular_velocity = turn * s.angular_velocity;
    }
    SphereBox b = scene_of(spheres);
    a.run(1000, 1e-5);
    b.run(1000, 1e-5);
    EXPECT_GT((a.spin(0) - spin_before).norm(), 1);  // they did rub
    return compare(a, b,
                   [&](Vec3 const& x, Vec3 const& v, Vec3 const& w)
                   {
                       return std::tuple<Vec3, Vec3, Vec3>(centre + turn.transpose() * (x - centre),
                                                           turn.transpose() * v, turn.transpose() * w);
                   });
}

/// Difference between a scene and the same that flies far faster than its spheres move in it, after 1000 steps.
Difference flying(std::vector<Sphere> spheres)
{
    Vec3 const flight(3, -5, 7);
    SphereBox a = scene_of(spheres);
    for (Sphere& s : spheres)
        s.velocity += flight;
    SphereBox b = scene_of(spheres);
    a.run(1000, 1e-5);
    b.run(1000, 1e-5);
    return compare(a, b,
                   [&](Vec3 const& x, Vec3 const& v, Vec3 const& w)
                   { return std::tuple<Vec3, Vec3, Vec3>(x - 1000 * 1e-5 * flight, v - flight, w); });
}

// Positions near 0.1 m are rounded to 1e-17, 1e-14 of a radius, in each step: 1000 steps give 1e-11 at most, and where
// the scene flies every step moves a position by 1e-4 m. A velocity is changed in the hundred steps of a contact only.
// In a heap every further contact multiplies what is different already.

TEST(Invariance, TurnedSceneMovesAlike)
{
    Difference const two = turned(pair()), many = turned(heap(3));
    print("rotation_invariance_pair", two);
    print("rotation_invariance_heap", many);
    expect_below(two, 1e-11, 2e-12);
    expect_below(many, 1e-9, 1e-9);
}

TEST(Invariance, FlyingSceneMovesAlike)
{
    Difference const two = flying(pair()), many = flying(heap(3));
    print("galilean_invariance_pair", two);
    print("galilean_invariance_heap", many);
    expect_below(two, 1e-10, 2e-12);
    expect_below(many, 1e-9, 1e-9);
}

}  // namespace

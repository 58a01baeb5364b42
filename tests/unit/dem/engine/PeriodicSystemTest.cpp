// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "OpenSpaceSystem.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "engine/StartChecks.hpp"

namespace
{

using gimdem::Case;
using gimdem::DemSystem;
using gimdem::ParticleState;
using gimdem::Vec3;
using namespace gimdem::test;

Case periodic_case(Vec3 const& size)
{
    Case settings = bead_case(0.8, 0.3);
    settings.domain.periodic = {true, true, true};
    settings.domain.box = {{{0, 0, 0}, {size.x(), size.y(), size.z()}}};
    return settings;
}

std::int64_t place_of(ParticleState const& p, std::int64_t id)
{
    return std::ranges::find(p.id.host(), id) - p.id.host().begin();
}

double constexpr radius = 1e-3;

/// Two spinning spheres that hit each other off centre.
std::vector<Sphere> collision_at(Vec3 const& x)
{
    return {{x - Vec3(1.1e-3, 0.3e-3, 0), radius, {0.2, 0.05, 0}, {10, 0, 30}},
            {x + Vec3(1.1e-3, 0.3e-3, 0), radius, {-0.2, 0, 0.02}, {0, -20, 5}}};
}

void expect_same_motion(DemSystem const& a, DemSystem const& b, double tolerance)
{
    for (std::int64_t id = 0; id < a.particles().count(); ++id)
    {
        auto const i = place_of(a.particles(), id), j = place_of(b.particles(), id);
        EXPECT_LT((a.particles().velocity[i].xyz() - b.particles().velocity[j].xyz()).norm(), 0.2 * tolerance);
        EXPECT_LT((a.particles().angular_velocity[i].xyz() - b.particles().angular_velocity[j].xyz()).norm(),
                  20 * tolerance);
    }
}

TEST(PeriodicSystem, CollisionAcrossTheBorderIsThatOfOpenSpace)
{
    Vec3 const size(0.01, 0.012, 0.011);
    // On a face, an edge and a corner of the box.
    for (Vec3 const& at : {Vec3(0, 6e-3, 5e-3), Vec3(0.01, 0, 5e-3), Vec3(0, 0.012, 0)})
    {
        OpenSpaceSystem open(bead_case(0.8, 0.3), collision_at({6e-3, 6e-3, 5e-3}));
        OpenSpaceSystem across(periodic_case(size), collision_at(at));
        double const before = open.system.particles().velocity[0].x;

        open.run(3000, 1e-6);
        across.run(3000, 1e-6);

        auto const& p = open.system.particles();
        ASSERT_LT(before * p.velocity[place_of(p, 0)].x, 0) << "they did not collide";
        // Overlaps of 5e-5 m are differences of positions of 1e-2 m: 4e-14 relative, over some hundred steps in touch.
        expect_same_motion(open.system, across.system, 1e-11);
    }
}

/// A gas of spheres of several sizes that fills the periodic box with 0.25 of solid.
std::vector<Sphere> gas(Vec3 const& drift)
{
    std::vector<Sphere> spheres;
    std::mt19937_64 random(5);
    auto const symmetric = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
    for (int k = 0; k < 5; ++k)
        for (int j = 0; j < 5; ++j)
            for (int i = 0; i < 5; ++i)
            {
                Vec3 const x = 2.4e-3 * (Vec3(i, j, k) + Vec3::Constant(0.5));
                double const r = (i + j + k) % 3 == 0 ? 1.15e-3 : 0.9e-3;
                spheres.push_back({x, r, drift + 0.2 * Vec3(symmetric(), symmetric(), symmetric()), Vec3(10, i, j)});
            }
    return spheres;
}

Vec3 momentum(ParticleState const& p)
{
    Vec3 sum = Vec3::Zero();
    for (auto const& v : p.velocity.host())
        sum += v.xyz() / v.w;
    return sum;
}

TEST(PeriodicSystem, MomentumIsConserved)
{
    OpenSpaceSystem gas_in_box(periodic_case(Vec3::Constant(0.012)), gas({0, 0, 0}));
    ParticleState const& p = gas_in_box.system.particles();
    Vec3 const before = momentum(p);
    double scale = 0;
    for (auto const& v : p.velocity.host())
        scale += v.xyz().norm() / v.w;

    gas_in_box.run(2000, 1e-5);

    EXPECT_GT(gas_in_box.system.rebuilds(), 5);
    // Forces cancel in pairs: rounding of 2000 steps.
    EXPECT_LT((momentum(p) - before).norm(), 1e-12 * scale);
    // Between two builds of the list a particle leaves the box by half the skin at most.
    for (auto const& x : p.position.host())
        EXPECT_LT((x.xyz() - Vec3::Constant(0.006)).cwiseAbs().maxCoeff(), 0.006 + 0.1 * 0.9e-3);
}

TEST(PeriodicSystem, DriftThroughTheBordersChangesNothing)
{
    Vec3 const drift(1.7, -0.9, 0.6);
    OpenSpaceSystem still(periodic_case(Vec3::Constant(0.012)), gas({0, 0, 0}));
    OpenSpaceSystem moving(periodic_case(Vec3::Constant(0.012)), gas(drift));

    // 0.01 s: the drifting gas goes through the box more than once along x.
    still.run(1000, 1e-5);
    moving.run(1000, 1e-5);

    for (auto& v : moving.system.particles().velocity.host())
        v.set_xyz(v.xyz() - drift);
    // Rounding, 1e-16, multiplied by a few collisions of each particle, a factor of 10 to 100 each.
    expect_same_motion(still.system, moving.system, 1e-8);
    ParticleState const& p = still.system.particles();
    auto const start = gas({0, 0, 0});
    int hit = 0;
    for (std::int64_t i = 0; i < p.count(); ++i)
        hit += (p.velocity[i].xyz() - start[static_cast<std::size_t>(p.id[i])].velocity).norm() > 0.01;
    EXPECT_GT(hit, 100);
}

TEST(PeriodicSystem, ThreadsDoNotChangeABit)
{
    OpenSpaceSystem one(periodic_case(Vec3::Constant(0.012)), gas({1, 0, 0}));
    OpenSpaceSystem three(periodic_case(Vec3::Constant(0.012)), gas({1, 0, 0}), {gimdem::exec::Backend::openmp, 3});
    one.run(300, 1e-5);
    three.run(300, 1e-5);
    auto const& a = one.system.particles().position.host();
    auto const& b = three.system.particles().position.host();
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size_bytes()), 0);
}

TEST(StartChecks, OverlapAcrossTheBorderIsSeen)
{
    auto const particles = particles_of({{{0.0005, 0.005, 0.005}, radius}, {{0.0092, 0.005, 0.005}, radius}});
    auto const domain = gimdem::Domain::of(periodic_case(Vec3::Constant(0.01)).domain);
    EXPECT_NO_THROW(gimdem::check_overlaps(serial, particles));
    EXPECT_THROW(gimdem::check_overlaps(serial, particles, domain), gimdem::UserError);
}

TEST(StartChecks, PeriodicCoupledRunIsRefused)
{
    EXPECT_NO_THROW(gimdem::refuse_periodic_coupled_run(bead_case()));
    EXPECT_THROW(gimdem::refuse_periodic_coupled_run(periodic_case({1, 1, 1})), gimdem::UserError);
}

}  // namespace

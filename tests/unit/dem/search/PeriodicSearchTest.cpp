// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "Pairs.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"

namespace
{

using gimdem::Domain;
using gimdem::NeighborList;
using gimdem::NeighborSearch;
using gimdem::ParticleState;
using gimdem::Vec3;
using namespace gimdem::test;

TEST(PeriodicSearch, NearestImageIsTheNearestOfAll)
{
    Domain const domain{{0, 0, 0}, {1, 0, 0.7}};
    auto const spheres = random_spheres(200, {-1, -1, -0.7}, {1, 1, 0.7}, 0, 0);
    for (std::size_t i = 1; i < spheres.size(); ++i)
    {
        Vec3 const a = domain.wrap(spheres[i].position), b = domain.wrap(spheres[i - 1].position);
        Vec3 d = a - b;
        domain.space().shorten(d.x(), d.y(), d.z());
        // One rounding of numbers up to 2.
        EXPECT_NEAR(d.norm(), distance_to_image(a, b, domain), 1e-15);
        EXPECT_EQ(d.y(), a.y() - b.y());
    }
}

TEST(PeriodicSearch, WrappedPositionsAreInTheBoxAndThoseInsideKeepTheirBits)
{
    Domain const domain{{-0.2, 0, 0.5}, {1, 2, 0}};
    Vec3 const inside(0.3, 1.9, -7), outside(0.9, -0.1, 9);
    EXPECT_EQ(domain.wrap(inside), inside);
    // Two roundings of numbers up to 2.
    EXPECT_NEAR((domain.wrap(outside) - Vec3(-0.1, 1.9, 9)).norm(), 0, 1e-15);
}

TEST(PeriodicSearch, WrappingAgainChangesNothing)
{
    // Just outside of either end, and where 1/L has no exact form: rounding puts some of them on the far end.
    for (double const low : {0.0, -0.3, 7.1})
        for (double const period : {1.0, 0.3, 0.07})
        {
            Domain const domain{{low, 0, 0}, {period, 0, 0}};
            for (double const off : {-1e-20, -1e-17, -1e-16, 0.0, 1e-17, 1e-16, 0.01})
                for (int k = -3; k <= 3; ++k)
                {
                    double const once = domain.wrap(Vec3(low + k * period + off, 0, 0)).x();
                    EXPECT_GE(once, low);
                    EXPECT_LT(once, low + period);
                    EXPECT_EQ(domain.wrap(Vec3(once, 0, 0)).x(), once);
                }
        }
    EXPECT_TRUE(std::isnan(Domain{{0, 0, 0}, {1, 0, 0}}.wrap(Vec3(NAN, 0, 0)).x()));
}

TEST(PeriodicSearch, ListsThePairsOfBruteForce)
{
    struct Scene
    {
        char const* name;
        Domain domain;
        double smallest, skin;
    };
    Scene const scenes[] = {
        {"all axes, one size", {{0, 0, 0}, {1, 0.7, 1.3}}, 0.05, 0.01},
        {"all axes, 10:1", {{0, 0, 0}, {1, 0.7, 1.3}}, 0.005, 0.01},
        {"x alone", {{0, 0, 0}, {1, 0, 0}}, 0.01, 0.03},
        {"z alone, one size", {{0, 0, 0}, {0, 0, 1.3}}, 0.05, 0.01},
        {"box of two cells", {{0.1, 0.1, 0.1}, {0.22, 0.23, 0.32}}, 0.05, 0.01},
        {"box of two cells, 10:1", {{0.1, 0.1, 0.1}, {0.22, 0.23, 0.32}}, 0.005, 0.01},
        {"not from the origin", {{-3.33, 0.2, 7}, {0.9, 0.9, 0.9}}, 0.01, 0.003},
    };
    for (Scene const& scene : scenes)
    {
        SCOPED_TRACE(scene.name);
        ParticleState p = particles_of(random_spheres(300, {-0.5, -0.5, -0.5}, {1, 1, 1}, scene.smallest, 0.05));
        NeighborList list;

        NeighborSearch(serial, scene.skin, scene.domain).build(p, list);

        // By brute force where the particles are now: in the box.
        Pairs const expected = by_brute_force(p, scene.skin, scene.domain);
        EXPECT_GT(expected.size(), by_brute_force(p, scene.skin).size());
        expect_list(p, list, expected);
    }
}

TEST(PeriodicSearch, WrappingDoesNotMakeAListStale)
{
    Domain const domain{{0, 0, 0}, {1, 1, 1}};
    ParticleState p = particles_of({{{0.999, 0.5, 0.5}, 0.05}, {{0.04, 0.5, 0.5}, 0.05}});
    NeighborList list;
    NeighborSearch search(serial, 0.02, domain);
    search.build(p, list);
    ASSERT_EQ(list.pair_count(), 1);
    for (auto& x : p.position.host())
        if (x.x > 0.5) x.x += 0.0099;

    EXPECT_FALSE(search.is_stale(p, list));
    for (auto& x : p.position.host())
        if (x.x > 0.5) x.x += 0.0002;
    EXPECT_TRUE(search.is_stale(p, list));
    search.build(p, list);
    EXPECT_EQ(list.pair_count(), 1);
    EXPECT_FALSE(search.is_stale(p, list));
    for (auto const& x : p.position.host())
        EXPECT_TRUE(x.x >= 0 && x.x < 1);
}

TEST(PeriodicSearch, BoxThatIsTooSmallIsRefused)
{
    ParticleState p = particles_of({{{0.1, 0.1, 0.1}, 0.05}});
    NeighborList list;
    // 2 (2 r + skin) = 0.22.
    EXPECT_NO_THROW(NeighborSearch(serial, 0.01, {{0, 0, 0}, {0, 0.2201, 0}}).build(p, list));
    try
    {
        NeighborSearch(serial, 0.01, {{0, 0, 0}, {0, 0.2199, 0}}).build(p, list);
        FAIL() << "was taken";
    }
    catch (gimdem::UserError const& error)
    {
        EXPECT_NE(std::string(error.what()).find("[domain] box is 0.2199 m long along y"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("at least 0.22 m"), std::string::npos);
    }
}

}  // namespace

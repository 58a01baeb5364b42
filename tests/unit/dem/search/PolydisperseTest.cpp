// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "Pairs.hpp"
#include "SameBits.hpp"
#include "TestCase.hpp"
#include "search/CellGrid.hpp"

namespace
{

using gimdem::NeighborList;
using gimdem::NeighborSearch;
using gimdem::ParticleState;
using gimdem::Vec3;
using namespace gimdem::test;

using Spheres = std::vector<Sphere>;

Spheres operator+(Spheres a, Spheres const& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Radii 0.01, 0.02, 0.04, 0.08 at whole and half multiples of the cell size of the largest, from where the grids
/// start.
Spheres on_cell_borders(double skin)
{
    Spheres spheres;
    for (int k = 0; k < 8; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 8; ++i)
                spheres.push_back({(0.08 + skin / 2) * Vec3(i, j, k), 0.08 / (1 << (i + 2 * j + 3 * k) % 4)});
    return spheres;
}

/// Tight groups far from each other.
Spheres clusters()
{
    Spheres all;
    for (unsigned c = 0; c < 5; ++c)
    {
        Vec3 const at = 20 * Vec3(c % 2, c % 3, c);
        all = all + random_spheres(60, at, at + Vec3::Constant(0.5), 0.01, 0.1, c + 1);
    }
    return all;
}

TEST(Polydisperse, ListsThePairsOfBruteForceInEveryScene)
{
    double const skin = 0.004;
    Spheres const small = random_spheres(300, {0, 0, 0}, {1, 1, 1}, 0.01, 0.02);
    struct Scene
    {
        char const* name;
        Spheres spheres;
    };
    Scene const scenes[] = {
        {"radii 10:1", random_spheres(500, {0, 0, 0}, {1, 0.7, 1.3}, 0.01, 0.1)},
        {"radii 100:1", random_spheres(200, {0, 0, 0}, {2, 2, 2}, 0.004, 0.4) + small},
        {"radii 1000:1, more than there are levels", small + Spheres{{{0, 0, 0}, 10}, {{1, 1, 1}, 0.01 / 1000}}},
        {"clusters", clusters()},
        {"on cell borders", on_cell_borders(skin)},
        {"one huge among small", small + Spheres{{{0.5, 0.5, 0.5}, 0.4}}},
        {"one huge outside", small + Spheres{{{-3, 0.5, 0.5}, 3}}},
        {"all in one place", random_spheres(60, {0, 0, 0}, {0.21, 0.21, 0.21}, 0.01, 0.1)},
        {"a line", random_spheres(300, {0, 0, 0}, {300, 0.21, 0.21}, 0.01, 0.1)},
        {"a plane", random_spheres(300, {0, 0, 0}, {3, 3, 0.21}, 0.01, 0.1)},
        {"exactly 2:1", Spheres{{{0, 0, 0}, 0.1}, {{0.152, 0, 0}, 0.05}, {{0.25, 0, 0}, 0.05}}},
    };
    for (Scene const& scene : scenes)
    {
        SCOPED_TRACE(scene.name);
        ParticleState p = particles_of(scene.spheres);
        Pairs const expected = by_brute_force(p, skin);
        EXPECT_FALSE(expected.empty());
        NeighborList list;

        NeighborSearch(serial, skin).build(p, list);

        expect_list(p, list, expected);
    }
}

TEST(Polydisperse, OneSizeIsSortedByOneGridAsEver)
{
    double const radius = 0.03, skin = 0.006;
    ParticleState p = particles_of(random_spheres(500, {0, 0, 0}, {1, 0.7, 1.3}, radius, radius));
    // What the order in memory is made of: the cell of the one grid over all centres, then the order before.
    Vec3 low = p.position[0].xyz(), high = low;
    for (auto const& x : p.position.host())
    {
        low = low.cwiseMin(x.xyz());
        high = high.cwiseMax(x.xyz());
    }
    auto const grid = gimdem::CellGrid::over(low, high, 2 * radius + skin, 8 * p.count() + 1000);
    std::vector<std::int64_t> expected(static_cast<std::size_t>(p.count()));
    std::iota(expected.begin(), expected.end(), 0);
    std::stable_sort(expected.begin(), expected.end(),
                     [&](auto a, auto b)
                     { return grid.cell_of(p.position[a].xyz()) < grid.cell_of(p.position[b].xyz()); });
    Pairs const pairs = by_brute_force(p, skin);
    NeighborList list;

    NeighborSearch(serial, skin).build(p, list);

    EXPECT_TRUE(std::ranges::equal(p.id.host(), expected));
    expect_list(p, list, pairs);
}

TEST(Polydisperse, SpringsFollowTheirPairs)
{
    ParticleState p = particles_of(random_spheres(300, {0, 0, 0}, {1, 1, 1}, 0.01, 0.1));
    NeighborList list;
    NeighborSearch search(serial, 0.01);
    search.build(p, list);
    give_springs(p, list);
    Pairs const before = ids_of(p, list);
    for (auto& x : p.position.host())
        x.set_xyz(Vec3(1, 1, 1) - 1.01 * x.xyz());

    search.build(p, list);

    EXPECT_GT(expect_springs_of(before, p, list), 100);
}

TEST(Polydisperse, ThreadsDoNotChangeTheList)
{
    // More than the 4096 from which on the threads share the sort.
    auto const spheres = random_spheres(9000, {0, 0, 0}, {1, 1, 1}, 0.002, 0.02);
    ParticleState one = particles_of(spheres), three = one;
    NeighborList list_of_one, list_of_three;

    NeighborSearch(serial, 0.002).build(one, list_of_one);
    NeighborSearch({gimdem::exec::Backend::openmp, 3}, 0.002).build(three, list_of_three);

    EXPECT_TRUE(same_bits(one.position, three.position));
    EXPECT_TRUE(same_bits(one.id, three.id));
    EXPECT_TRUE(same_bits(list_of_one.row_offsets, list_of_three.row_offsets));
    EXPECT_TRUE(same_bits(list_of_one.second, list_of_three.second));
    EXPECT_TRUE(same_bits(list_of_one.border.by_second.members, list_of_three.border.by_second.members));
    EXPECT_TRUE(same_bits(list_of_one.border.by_second.offsets, list_of_three.border.by_second.offsets));
}

struct Cost
{
    double candidates, pairs;  ///< per particle
    double in_one_grid;        ///< candidates per particle if all shared the cells of the largest
};

/// Spheres at random that fill 0.4 of a cube, `share` of their volume with the radius 1, the rest with 1/ratio; or, for
/// a negative share, with equal volumes in all octaves of radius between the two.
Cost cost_of_search(double ratio, double share)
{
    int const count = 30000;
    std::mt19937_64 random(11);
    auto const uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    double const large_share = 1 / (1 + (1 - share) / share * std::pow(ratio, 3));  // by number
    Spheres spheres;
    double volume = 0;
    for (int i = 0; i < count; ++i)
    {
        // Numbers that fall with the third power of the radius, by inversion of their distribution.
        double const continuous = std::pow(1 + uniform() * (std::pow(ratio, 3) - 1), -1.0 / 3);
        double const radius = share < 0 ? continuous : uniform() < large_share ? 1 : 1 / ratio;
        spheres.push_back({Vec3::Zero(), radius});
        volume += gimdem::sphere_volume(radius);
    }
    double const side = std::cbrt(volume / 0.4);
    for (Sphere& s : spheres)
        s.position = side * Vec3(uniform(), uniform(), uniform());
    ParticleState p = particles_of(spheres);
    NeighborList list;
    NeighborSearch search(serial, 0.3 / ratio);
    search.build(p, list);
    double const n = count, edge = 2 + 0.3 / ratio;
    return {static_cast<double>(search.count_candidates(p)) / n, static_cast<double>(list.pair_count()) / n,
            13.5 * std::pow(edge / side, 3) * n};
}

TEST(Polydisperse, CostOfTheSearchDoesNotDependOnTheRatioOfSizes)
{
    // Of one size, half of 27 cubes of edge c = 2 r + skin is looked at for half the pairs in a sphere of radius c:
    // 27 / (4 pi / 3) = 6.4 candidates for a pair. Within a level the radii differ by up to two, and if all but one
    // were of the smallest, it would be eight times as many, 52. Measured: up to 22 for a pair, 30 for a particle.
    for (double const share : {0.5, 0.9, -1.0})
        for (double const ratio : {1.0, 1.5, 3.0, 10.0, 30.0})
        {
            if (share > 0 && ratio > 10) continue;  // there would be no large one among so few
            Cost const cost = cost_of_search(ratio, share);
            fmt::print(
                "figure: candidates_{}_{}to1 = {:.3g} [1/particle], {:.3g} [1/pair], one grid: {:.3g} "
                "[1/particle]\n",
                share < 0      ? "continuous"
                : share == 0.5 ? "half_large"
                               : "most_large",
                ratio, cost.candidates, cost.candidates / cost.pairs, cost.in_one_grid);
            EXPECT_LT(cost.candidates, 26 * cost.pairs) << ratio << ' ' << share;
            EXPECT_LT(cost.candidates, 36) << ratio << ' ' << share;
            EXPECT_GT(cost.candidates, cost.pairs);
        }
}

}  // namespace

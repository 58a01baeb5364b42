// SPDX-License-Identifier: BSD-3-Clause
/// Share of a particle's volume that a method puts into the wrong cells of a cubic lattice, against the exact overlap:
/// the table of theory.md, (G.30), and a table that was sampled elsewhere.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "CellMeshes.hpp"
#include "Figure.hpp"
#include "Mapped.hpp"
#include "SparseWeights.hpp"
#include "particles/Random.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr int cells_along = 7;
constexpr double ratios[8] = {1, 1.25, 1.56, 1.76, 2.38, 3, 4, 6};

struct Row
{
    char const* method;
    double stated;    ///< error that the table claims
    double share[8];  ///< at these a / d_p
};

// Sampled independently, overlap included: at 400 random places, by 20,000 random points in the sphere. Rounded to the
// digits that are here. It claims to be good to 0.01 and for fbsi 0.002; for pcm that is just one scatter of the
// places.
constexpr Row sampled_table[] = {
    {"pcm", 1, {0.471, 0.400, 0.313, 0.282, 0.234, 0.170, 0.131, 0.080}},
    {"divided", 0.01, {0.089, 0.079, 0.060, 0.058, 0.046, 0.034, 0.027, 0.018}},
    {"gim", 0.01, {0.296, 0.245, 0.206, 0.186, 0.141, 0.113, 0.077, 0.051}},
    {"gim-fixed", 0.01, {0.090, 0.098, 0.120, 0.136, 0.193, 0.264, 0.353, 0.499}},
    {"fbsi", 0.002, {0.018, 0.013, 0.010, 0.007, 0.006, 0.004, 0.0025, 0.0016}},
};
constexpr int sampled_places = 400, sampled_points = 20'000;

double half_digit(double share)
{
    return share < 0.0035 ? 0.00005 : 0.0005;
}

/// Places in the middle one of 7^3 unit cells, one at random in each of n^3 equal parts of it.
std::vector<Vec3> places_in_middle(int n, RandomStream& random)
{
    std::vector<Vec3> places;
    for (int i = 0; i < n * n * n; ++i)
    {
        double const x = random.unit(), y = random.unit(), z = random.unit();
        places.push_back(Vec3::Constant(cells_along / 2) + Vec3(i % n + x, i / n % n + y, i / n / n + z) / n);
    }
    return places;
}

/// Spheres of diameter 1/ratio on 7^3 unit cells, and their weights by a method.
struct Lattice
{
    std::vector<SparseRow> weights(char const* name, std::vector<Vec3> const& places, double ratio) const
    {
        std::vector<Sphere> spheres;
        for (Vec3 const& x : places)
            spheres.push_back({x, 0.5 / ratio});
        return sparse_rows(Mapped(mesh, method(name), spheres).mapper);
    }

    PolyMesh mesh{hexahedra(cells_along, {1, 1, 1}).mesh()};
};

/// Shares of a sphere by random points: the cell of a point is known from its coordinates.
SparseRow sampled_overlap(Vec3 const& x, double radius, RandomStream& random)
{
    SparseRow row;
    for (int i = 0; i < sampled_points;)
    {
        double const a = random.between(-1, 1), b = random.between(-1, 1), c = random.between(-1, 1);
        if (a * a + b * b + c * c > 1) continue;
        ++i;
        Vec3 const point = x + radius * Vec3(a, b, c);
        auto const at = [&](int axis) { return static_cast<std::int32_t>(point[axis]); };
        std::int32_t const cell = at(0) + cells_along * (at(1) + cells_along * at(2));
        auto const entry = std::ranges::find(row, cell, &CellWeight::cell);
        if (entry == row.end())
            row.push_back({cell, 1.0 / sampled_points});
        else
            entry->weight += 1.0 / sampled_points;
    }
    std::ranges::sort(row);
    return row;
}

/// Of the shares at many places.
struct Moments
{
    double mean, deviation;
};

Moments moments_of(std::vector<SparseRow> const& weights, std::vector<SparseRow> const& overlaps)
{
    double sum = 0, squares = 0;
    for (std::size_t p = 0; p < weights.size(); ++p)
    {
        double const share = share_in_wrong_cells(weights[p], overlaps[p]);
        sum += share;
        squares += share * share;
    }
    auto const n = static_cast<double>(weights.size());
    return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)))};
}

/// The table beside ours, by method.
struct Comparison
{
    double deviation = 0;  ///< of the table's numbers from ours, the largest
    double sampled = 0;    ///< the same with the points' noise on ours
    double scatter = 0;    ///< of the mean of 400 places, the largest

    void print(std::string const& name) const
    {
        figure("wrong_cells_largest_deviation_" + name, deviation);
        figure("wrong_cells_largest_deviation_as_sampled_" + name, sampled);
        figure("wrong_cells_largest_scatter_" + name, scatter);
    }
};

/// What is mapped at one a / d_p: many places for means, few of which the overlap is sampled too.
struct AtRatio
{
    AtRatio(Lattice const& on, double a_over_d, std::vector<Vec3> const& at_many, std::vector<Vec3> const& at_few)
        : lattice(on),
          ratio(a_over_d),
          many(at_many),
          few(at_few),
          exact(on.weights("exact", many, ratio)),
          exact_few(on.weights("exact", few, ratio))
    {
        RandomStream random(31);
        for (Vec3 const& x : few)
            sampled.push_back(sampled_overlap(x, 0.5 / ratio, random));
    }

    /// What the points' own noise adds to the share on average.
    double noise(char const* name) const
    {
        auto const weights = lattice.weights(name, few, ratio);
        return moments_of(weights, sampled).mean - moments_of(weights, exact_few).mean;
    }

    void compare(Row const& row, double tabulated, Comparison& all) const
    {
        auto const [mean, deviation] = moments_of(lattice.weights(row.method, many, ratio), exact);
        double const points = noise(row.method), scatter = deviation / std::sqrt(sampled_places);
        double const tolerance = std::min(row.stated, 3.2 * scatter + half_digit(tabulated));
        figure(fmt::format("wrong_cells_{}_at_{}", row.method, ratio), mean);
        EXPECT_NEAR(mean + points, tabulated, row.method == std::string("fbsi") ? row.stated : tolerance)
            << row.method << " at a/dp = " << ratio;
        // Sampled and exact overlap are the same: where half of a sphere is in a cell the points err by 0.0028.
        EXPECT_NEAR(points, 0.0005, 0.0015) << row.method << " at a/dp = " << ratio;
        all.deviation = std::max(all.deviation, std::abs(mean - tabulated));
        all.sampled = std::max(all.sampled, std::abs(mean + points - tabulated));
        all.scatter = std::max(all.scatter, scatter);
    }

    Lattice const& lattice;
    double ratio;
    std::vector<Vec3> many, few;
    std::vector<SparseRow> exact, exact_few, sampled;
};

// Were the table sampled again, its places would scatter a mean by `deviation / sqrt(400)`, and its points would add
// their noise. Of 40 numbers all are within 3.2 scatters in 19 of 20 such tables. Only fbsi's are not (its numbers at
// 1.56 and 2.38 are 3 to 5 scatters too large, which nothing here explains) but they are within the 0.002 claimed.
TEST(WrongCells, SharesAreThoseOfTheSampledTable)
{
    Lattice const lattice;
    RandomStream random(23);
    auto const many = places_in_middle(16, random), few = places_in_middle(6, random);
    Comparison of_row[std::size(sampled_table)];
    for (std::size_t k = 0; k < 8; ++k)
    {
        AtRatio const at(lattice, ratios[k], many, few);
        for (std::size_t r = 0; r < std::size(sampled_table); ++r)
            at.compare(sampled_table[r], sampled_table[r].share[k], of_row[r]);
    }
    for (std::size_t r = 0; r < std::size(sampled_table); ++r)
        of_row[r].print(sampled_table[r].method);
}

}  // namespace

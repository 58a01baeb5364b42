// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/GaussianTable.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "mapping/GaussianIntegral.hpp"
#include "mapping/Mapper.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

/// Tables for one sphere of each radius in a box of unit cells.
struct UnitCells
{
    explicit UnitCells(std::vector<double> const& radii)
    {
        std::vector<Sphere> spheres;
        for (double const r : radii)
            spheres.push_back({{1.5, 1.5, 1.5}, r});
        usable = tables.provide(particles_of(spheres));
    }

    PolyMesh mesh{BoxMesh::make({3, 3, 3}, {3, 3, 3})};
    GaussianTables tables{mesh};
    bool usable;
};

double closed_form(double radius, double volume, double mu)
{
    double const log_ratio = std::log(volume / sphere_volume(radius));
    return GaussianIntegral{radius, log_ratio, tuned_coefficient(log_ratio)}(mu);
}

TEST(GaussianTable, KeepsItsErrorBoundAtAllDistances)
{
    // From a hundredth of a cell's size to twice the cell's: both orders of the two volumes.
    std::vector<double> const radii{0.01, 0.05, 0.2, 0.35, 0.45, 0.8, 1.2};
    UnitCells const cells(radii);
    ASSERT_TRUE(cells.usable);
    auto const view = cells.tables.view();
    for (double const r : radii)
        for (int i = 0; i < 20'000; ++i)
        {
            double const mu = i * 4e-4;
            ASSERT_NEAR(view(view.row(r)[0], mu * mu), closed_form(r, 1, mu), GaussianTables::error_bound)
                << "radius " << r << ", distance " << mu;
        }
}

TEST(GaussianTable, VolumesThatDifferInTheLastDigitsShareATable)
{
    auto topology = BoxMesh::make({20, 3, 3}, {2, 0.3, 0.3});
    for (std::size_t p = 0; p < topology.points.size(); p += 3)
        topology.points[p] += 1e-9 * std::sin(double(p));
    PolyMesh const mesh(topology);
    GaussianTables tables(mesh);
    ASSERT_TRUE(tables.provide(particles_of({{{1, 0.15, 0.15}, 0.02}})));
    auto const view = tables.view();
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        for (double mu = 0; mu < 0.4; mu += 1e-3)
            // The volumes differ by 4e-8 at most, and |d I / d ln V_c| < 1.
            ASSERT_NEAR(view(view.row(0.02)[c], mu * mu), closed_form(0.02, mesh.volume(c), mu), 4e-8);
}

TEST(GaussianTable, RefusesSphereAsLargeAsACell)
{
    double const equal = std::cbrt(3 / (4 * M_PI));
    EXPECT_FALSE(UnitCells({equal * (1 + 1e-4)}).usable);
    EXPECT_TRUE(UnitCells({equal * 0.7}).usable);
}

TEST(GaussianTable, RefusesManyRadii)
{
    std::vector<double> radii;
    for (std::size_t i = 0; i <= GaussianTables::most_tables; ++i)
        radii.push_back(0.1 + 1e-4 * double(i));
    EXPECT_FALSE(UnitCells(radii).usable);
}

TEST(GaussianTable, WeightsFromTablesAndFromTheClosedFormAgree)
{
    // A second radius, far from the others, makes the scene one without tables: sphere as large as a cell.
    PolyMesh const mesh(BoxMesh::make({9, 7, 8}, {9, 7, 8}));
    auto spheres = random_spheres(200, {0.5, 0.5, 0.5}, {8.5, 6.5, 7.5}, 0.2, 0.2);
    auto const weights = [&]
    {
        Mapper mapper(serial, mesh);
        exec::Buffer<std::uint8_t> faces(mesh.face_count());
        faces.fill(0);
        auto const particles = particles_of(spheres);
        mapper.locate(particles, faces);
        mapper.compute_weights(particles);
        return mapper.weights();
    };
    auto const from_tables = weights();
    spheres.push_back({{8.9, 6.9, 7.9}, std::cbrt(3 / (4 * M_PI))});  // in the last cell: its row comes last
    auto const closed = weights();
    ASSERT_GT(closed.size(), from_tables.size());
    for (std::int64_t k = 0; k < from_tables.size(); ++k)
        ASSERT_NEAR(from_tables[k], closed[k], 2 * GaussianTables::error_bound) << k;
}

}  // namespace

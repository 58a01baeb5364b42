// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/CellCurves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "BoxMesh.hpp"
#include "CellMeshes.hpp"
#include "TestCase.hpp"
#include "mapping/GaussianIntegral.hpp"
#include "mapping/Mapper.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

double closed_form(double radius, double volume, double mu)
{
    double const log_ratio = std::log(volume / sphere_volume(radius));
    return GaussianIntegral{radius, log_ratio, tuned_coefficient(log_ratio)}(mu);
}

/// I / V_p at one distance from the centre of a cell of volume 1.
double curve_at(CellCurve const& curve, double mu)
{
    using exec::Octet;
    Octet const zero = Octet::Constant(0);
    return curve({Octet::Constant(mu), zero, zero, zero})[3];
}

TEST(CellCurve, KeepsItsErrorBoundAtAllDistances)
{
    // Volumes of cells from 250 times that of the sphere to a twentieth of it, but for those close to it.
    for (double const r : {0.1, 0.15, 0.2, 0.25, 0.3, 0.9, 1.2, 1.7})
    {
        CellCurve curve;
        ASSERT_LT(2 * make_curve(curve, r, {0, 0, 0, 1}, 0), CellCurves::error_bound) << "radius " << r;
        for (int i = 0; i < 20'000; ++i)
        {
            double const mu = i * 6e-4;
            ASSERT_NEAR(curve_at(curve, mu), closed_form(r, 1, mu), CellCurves::error_bound)
                << "radius " << r << ", distance " << mu;
        }
    }
}

TEST(CellCurve, EndsWithoutAStepWhereNothingIsLeft)
{
    CellCurve curve;
    make_curve(curve, 0.2, {0, 0, 0, 1}, 0);
    double const last = std::sqrt((CellCurve::end + curve.offset) / curve.scale);
    for (double const mu : {last * (1 - 1e-9), last * (1 + 1e-9), last * 1.1, last * 100})
        EXPECT_NEAR(curve_at(curve, mu), 0, CellCurves::error_bound) << mu;
    EXPECT_GT(curve_at(curve, last * 0.9), CellCurves::error_bound);
}

TEST(CellCurve, IsRefusedForASphereAsLargeAsTheCell)
{
    CellCurve curve;
    double const equal = std::cbrt(3 / (4 * M_PI));
    EXPECT_GT(make_curve(curve, equal * 1.01, {0, 0, 0, 1}, 0), CellCurves::error_bound);
    EXPECT_GT(make_curve(curve, equal * 0.99, {0, 0, 0, 1}, 0), CellCurves::error_bound);
}

/// Weights on Voronoi cells, all of different volumes, against the closed form pair by pair. Returns how many weights
/// there were.
std::int64_t compare_weights(std::vector<Sphere> const& spheres)
{
    PolyMesh const mesh(voronoi_cells(6, {6, 6, 6}).mesh());
    ParticleState const particles = particles_of(spheres);
    Mapper mapper(serial, mesh);
    exec::Buffer<std::uint8_t> faces(mesh.face_count());
    faces.fill(1);
    mapper.locate(particles, faces);
    mapper.compute_weights(particles);
    CellRows const& rows = mapper.layers();
    std::int64_t at = 0;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        for (std::int64_t p = 0; p < particles.count(); ++p)
        {
            if (mapper.cell_of()[p] != c) continue;
            Quad const x = particles.position[p];
            std::vector<double> expected;
            double total = 0;
            for (std::int32_t k = rows.offsets[c]; k < rows.offsets[c + 1]; ++k)
            {
                std::int32_t const other = rows.cells[k];
                expected.push_back(closed_form(x.w, mesh.volume(other), (x.xyz() - mesh.centroid(other)).norm()));
                total += expected.back();
            }
            // Each integral is off by the bound at most, and so is each part of the total.
            double const bound = (1 + double(expected.size())) * CellCurves::error_bound / total;
            for (double const integral : expected)
                EXPECT_NEAR(mapper.weights()[at++], integral / total, bound) << "cell " << c << ", particle " << p;
        }
    EXPECT_EQ(at, mapper.weights().size());
    return at;
}

TEST(CellCurves, WeightsAreTheClosedFormsForAFewRadii)
{
    auto spheres = random_spheres(600, {0.5, 0.5, 0.5}, {5.5, 5.5, 5.5}, 0.18, 0.18);
    // As many as fill several eights in one cell, of two radii by turns, and some as large as small cells.
    for (int i = 0; i < 50; ++i)
        spheres.push_back({{3 + 1e-3 * i, 3, 3}, i % 2 == 0 ? 0.18 : 0.3});
    for (int i = 0; i < 20; ++i)
        spheres.push_back({{1 + 0.2 * i, 2, 3}, 0.55});
    EXPECT_GT(compare_weights(spheres), 670 * 30);
}

TEST(CellCurves, WeightsAreTheClosedFormsForManyRadii)
{
    EXPECT_GT(compare_weights(random_spheres(200, {0.5, 0.5, 0.5}, {5.5, 5.5, 5.5}, 0.1, 0.7)), 200 * 30);
}

}  // namespace

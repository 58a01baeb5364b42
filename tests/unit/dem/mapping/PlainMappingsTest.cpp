// SPDX-License-Identifier: BSD-3-Clause
/// The quick ways of computing weights against those that are first written down.
#include "PlainMappings.hpp"

#include <gtest/gtest.h>

#include "CellMeshes.hpp"
#include "Mapped.hpp"
#include "mapping/ClosedFormIntegrals.hpp"
#include "mapping/GaussianIntegral.hpp"
#include "mapping/GaussianTable.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

std::vector<CellList> meshes()
{
    return {hexahedra(5, {0.2, 0.2, 0.2}), hexahedra(5, {0.2, 0.2, 0.8}), tetrahedra(3, {0.3, 0.3, 0.3}),
            voronoi_cells(4, {1, 1, 1}), shaken(hexahedra(4, {0.25, 0.25, 0.25}), 0.2)};
}

/// Largest difference of a weight from the plain one.
template <class Shares>
double largest_difference(Mapped const& m, Shares const& share)
{
    std::vector<double> expected;
    double largest = 0;
    std::int64_t row = 0;
    CellRows const& rows = m.mapper.layers();
    for (std::int32_t c = 0; c < rows.offsets.size() - 1; ++c)
        for (std::int64_t p = 0; p < m.particles.count(); ++p)
        {
            if (m.mapper.cell_of()[p] != c) continue;
            int const length = rows.offsets[c + 1] - rows.offsets[c];
            expected.resize(static_cast<std::size_t>(length));
            plain_weights(share, m.particles.position[p], rows.cells.view().data + rows.offsets[c], length,
                          expected.data());
            for (double const w : expected)
                largest = std::max(largest, std::abs(w - m.mapper.weights()[row++]));
        }
    EXPECT_EQ(row, m.mapper.weights().size());
    return largest;
}

TEST(PlainMappings, FaceSoftIntersectionIsTheSame)
{
    for (CellList const& cells : meshes())
    {
        PolyMesh const mesh(cells.mesh());
        Mapped const m(mesh, method("fbsi"), random_spheres(200, mesh.low(), mesh.high(), 0.03, 0.2));
        // Distances of some 0.1 as differences of places up to 4, times 1/r up to 30 and 15 faces.
        EXPECT_LT(largest_difference(m, PlainFbsi{mesh.view()}), 1e-12);
    }
}

TEST(PlainMappings, GimOfManyRadiiIsTheSame)
{
    for (CellList const& cells : meshes())
    {
        PolyMesh const mesh(cells.mesh());
        // Smaller than any cell, as the paper's formula is for those, and reaching the centre of one: it subtracts
        // numbers near to V_c, up to 300 V_p, from each other, which leaves 1e-13 of integrals above 0.1 V_p.
        std::vector<Sphere> spheres = random_spheres(2000, mesh.low(), mesh.high(), 0.02, 0.03);
        std::erase_if(spheres,
                      [&](Sphere const& s)
                      {
                          for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
                              if ((mesh.centroid(c) - s.position).norm() < 0.1) return false;
                          return true;
                      });
        ASSERT_GT(spheres.size(), GaussianTables::most_tables);  // more radii than there are tables for
        Mapped const m(mesh, method("gim"), spheres);
        EXPECT_LT(largest_difference(m, PlainGim{mesh.view()}), 1e-12);
    }
}

TEST(PlainMappings, ExactOverlapIsTheSame)
{
    for (CellList const& cells : meshes())
    {
        PolyMesh const mesh(cells.mesh());
        overlap::CellFacets const facets(mesh);
        Mapped const m(mesh, method("exact"), random_spheres(200, mesh.low(), mesh.high(), 0.03, 0.2));
        // (G.24) of cells that are r / 100 large or less away: cubes of distances up to 100 r^3, 1e-14 each.
        EXPECT_LT(largest_difference(m, PlainExact{facets.view()}), 1e-10);
    }
}

/// Shared integrals I / V_p of one particle with cells of unit spheres' volumes times `ratios`, at distances.
TEST(ClosedFormIntegrals, AreTheIntegralInEveryBranch)
{
    for (double const radius : {0.3, 1.0, 1.7})
        for (double const ratio : {0.01, 0.3, 0.999999, 1.0, 1.0 + 1e-14, 1.001, 3.0, 100.0, 1e5})
            for (double const mu : {0.0, 1e-9, 0.05, 0.5, 1.0, 2.5, 7.0, 30.0, 400.0})
            {
                double const volume = ratio * sphere_volume(radius);
                double const cell_radius = radius * std::cbrt(ratio);
                CellSize const size{cell_radius, std::log(cell_radius), std::pow(cell_radius, -3 * 0.132),
                                    1 / cell_radius};
                for (double const fixed : {0.0, 0.4})
                {
                    Quad const cell{0, 0, 0, volume};
                    std::int32_t const candidate = 0;
                    CandidateCentres const at(&cell, &candidate, 1);
                    ClosedFormIntegrals const integrals({&size, fixed}, at);
                    double shared = -1;
                    integrals({0, mu * radius, 0, radius}, &shared);
                    double const log_ratio = std::log(ratio);
                    double const expected = GaussianIntegral{
                        radius, log_ratio, fixed > 0 ? fixed : tuned_coefficient(log_ratio)}(mu * radius);
                    // Places of crossings are good to some roundings, and the integral's slope in them is below one.
                    EXPECT_NEAR(shared, expected, 4e-15) << ratio << ' ' << mu << ' ' << fixed;
                }
            }
}

}  // namespace

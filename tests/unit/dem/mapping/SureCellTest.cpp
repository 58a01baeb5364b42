// SPDX-License-Identifier: BSD-3-Clause
/// A particle's cell is the same whether it is looked for at each step or only after it has gone far enough.
#include "mapping/SureCell.hpp"

#include <gtest/gtest.h>

#include <random>

#include "CellMeshes.hpp"
#include "TestCase.hpp"
#include "mapping/Mapper.hpp"
#include "mesh/NearbyCells.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

Vec3 random_vector(std::mt19937_64& random)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    double const x = uniform(random), y = uniform(random);
    return {x, y, uniform(random)};
}

/// Particles that wander through a mesh of a box [0, edge]^3 by steps of up to `step` along each axis.
void wander(PolyMesh const& mesh, double edge, double step)
{
    auto spheres = random_spheres(400, {0, 0, 0}, {edge, edge, edge}, 0.2, 0.2);
    exec::Buffer<std::uint8_t> faces(mesh.face_count());
    faces.fill(1);
    Mapper mapper(serial, mesh);
    BoxGrid const grid(cell_boxes(mesh));
    CellFinder const find{mesh.view(), grid.view()};
    std::mt19937_64 random(4);
    int changes = 0;
    std::vector<std::int32_t> cells(spheres.size(), -1);
    for (int k = 0; k < 40; ++k)
    {
        ParticleState const particles = particles_of(spheres);
        mapper.locate(particles, faces);
        for (std::size_t p = 0; p < spheres.size(); ++p)
        {
            Vec3& x = spheres[p].position;
            std::int32_t const cell = find(cells[p], x).cell;
            ASSERT_EQ(mapper.cell_of()[static_cast<std::int64_t>(p)], cell)
                << "step " << k << ", particle " << p << " at " << x.transpose();
            changes += cells[p] != cell;
            cells[p] = cell;
            // A little beyond the walls too, less than the radius: there the cell is the last one before.
            x = (x + step * random_vector(random)).cwiseMax(-0.1).cwiseMin(edge + 0.1);
        }
    }
    EXPECT_GT(changes, 400 + 100);
}

TEST(SureCell, IsTheOneThatIsFoundAmongPlaneFaces)
{
    PolyMesh const mesh(voronoi_cells(5, {5, 5, 5}).mesh());
    wander(mesh, 5, 0.03);
    wander(mesh, 5, 0.3);
}

TEST(SureCell, IsTheOneThatIsFoundAmongWarpedFaces)
{
    PolyMesh const mesh(shaken(hexahedra(5, {1, 1, 1}), 0.15).mesh());
    wander(mesh, 5, 0.03);
    wander(mesh, 5, 0.3);
}

TEST(SurfaceDistance, IsThatToThePlanesOfACube)
{
    PolyMesh const mesh(hexahedra(3, {1, 1, 1}).mesh());
    SurfaceDistance const distance{mesh.view()};
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        Vec3 const x = mesh.centroid(c) + Vec3(0.2, -0.41, 0.3);
        EXPECT_NEAR(distance(c, x), 0.09, 1e-14);
    }
}

TEST(SurfaceDistance, NoOtherCellIsNearer)
{
    auto const topology = shaken(hexahedra(5, {1, 1, 1}), 0.15).mesh();
    PolyMesh const mesh(topology);
    BoxGrid const grid(cell_boxes(mesh));
    CellFinder const find{mesh.view(), grid.view()};
    std::mt19937_64 random(5);
    int near = 0;
    for (int i = 0; i < 4000; ++i)
    {
        Vec3 const x = Vec3(2.5, 2.5, 2.5) + 2 * random_vector(random);
        Location const at = find(-1, x);
        double const distance = SurfaceDistance{mesh.view()}(at.cell, x);
        near += !at.is_certain;
        for (int k = 0; k < 10; ++k)
            ASSERT_EQ(find(-1, x + 0.999 * distance * random_vector(random).normalized()).cell, at.cell)
                << x.transpose();
    }
    EXPECT_GT(near, 400);  // those near warped faces, whose distance is that of the triangles
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
/// Every way of mapping: what all of them keep, and what each of them is.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "CellMeshes.hpp"
#include "Mapped.hpp"
#include "core/Error.hpp"
#include "core/MappingMethodNames.hpp"
#include "mapping/GaussianIntegral.hpp"
#include "mapping/GaussianTable.hpp"
#include "mapping/Mapper.hpp"
#include "mapping/overlap/CellOverlap.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

class EveryMethod : public testing::TestWithParam<std::string_view>
{
};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn(mapping_method_names),
                         [](auto const& tested)
                         {
                             std::string name(tested.param);
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(EveryMethod, KeepsVolumeAndMomentumOnAnyMesh)
{
    for (CellList const& cells :
         {hexahedra(5, {0.2, 0.2, 0.2}), hexahedra(5, {0.2, 0.2, 0.8}), tetrahedra(3, {0.3, 0.3, 0.3}),
          voronoi_cells(4, {1, 1, 1}), shaken(hexahedra(4, {0.25, 0.25, 0.25}), 0.2)})
    {
        PolyMesh const mesh(cells.mesh());
        Vec3 const margin = Vec3::Constant(0.02);
        // Some are larger than a cell, some in a wall by a part of their radius.
        Mapped const m(mesh, method(GetParam()),
                       random_spheres(200, mesh.low() - margin, mesh.high() + margin, 0.03, 0.2));
        double solid = 0, drag_coefficient = 0, volume = 0, coefficient = 0;
        Vec3 drag = Vec3::Zero(), given = Vec3::Zero();
        for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        {
            EXPECT_GE(m.sums.solid_volume[c], -1e-14);  // the solver of diffusion
            solid += m.sums.solid_volume[c];
            drag += m.sums.drag[c].xyz();
            drag_coefficient += m.sums.drag[c].w;
        }
        for (std::int64_t p = 0; p < m.particles.count(); ++p)
        {
            volume += m.particles.volume(p);
            given += m.impulses[p].drag.xyz();
            coefficient += m.impulses[p].drag.w;
        }
        // Rounding of some ten thousand terms.
        EXPECT_NEAR(solid / volume, 1, 1e-13);
        EXPECT_NEAR(drag_coefficient / coefficient, 1, 1e-13);
        EXPECT_LT((drag - given).norm(), 1e-13 * 200 * 1e-6);
    }
}

TEST_P(EveryMethod, ThreadsDoNotChangeABit)
{
    PolyMesh const mesh(voronoi_cells(4, {1, 1, 1}).mesh());
    auto const spheres = random_spheres(300, {0, 0, 0}, {1, 1, 1}, 0.03, 0.12);
    Mapped const one(mesh, method(GetParam()), spheres);
    Mapped const three(mesh, method(GetParam()), spheres, {exec::Backend::openmp, 3});
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        EXPECT_EQ(one.sums.solid_volume[c], three.sums.solid_volume[c]);
        EXPECT_EQ(one.sums.drag[c].xyz(), three.sums.drag[c].xyz());
    }
}

TEST_P(EveryMethod, LoneCellTakesAll)
{
    PolyMesh const mesh(hexahedra(1, {1, 1, 1}).mesh());
    Mapped const m(mesh, method(GetParam()), {{{0.3, 0.95, 0.5}, 0.1}, {{0.5, 0.5, 0.5}, 0.9}});
    EXPECT_NEAR(m.sums.solid_volume[0], m.particles.volume(0) + m.particles.volume(1), 1e-14);
}

TEST_P(EveryMethod, ParticlesOfAGrowingSizeFindTheirCells)
{
    PolyMesh const mesh(hexahedra(7, {1, 1, 1}).mesh());
    Mapped m(mesh, method(GetParam()), {{{3.5, 3.5, 3.5}, 0.3}});
    exec::Buffer<std::uint8_t> walls(mesh.face_count());
    walls.fill(1);
    for (double const radius : {0.6, 1.7, 0.4})
    {
        auto const particles = particles_of({{{3.4, 3.5, 3.5}, radius}, {{0.2, 0.3, 6.4}, 0.1}});
        m.mapper.locate(particles, walls);
        m.mapper.compute_weights(particles);
        m.mapper.sum_into_cells(particles, {}, m.sums);
        double solid = 0;
        for (double const v : m.sums.solid_volume.host())
            solid += v;
        EXPECT_NEAR(solid / (particles.volume(0) + particles.volume(1)), 1, 1e-14) << radius;
    }
}

/// Cell of a point in a lattice of n^3 unit cubes.
std::int32_t cube_of(Vec3 const& x, int n)
{
    return static_cast<std::int32_t>(std::floor(x.x())) +
           n * (static_cast<std::int32_t>(std::floor(x.y())) + n * static_cast<std::int32_t>(std::floor(x.z())));
}

TEST(ParticleCentre, IsACountOfCentres)
{
    PolyMesh const mesh(hexahedra(4, {1, 1, 1}).mesh());
    auto const spheres = random_spheres(300, {0, 0, 0}, {4, 4, 4}, 0.1, 0.3);
    Mapped const m(mesh, method("pcm"), spheres);
    std::vector<double> expected(64, 0.0);
    for (Sphere const& s : spheres)
        expected[static_cast<std::size_t>(cube_of(s.position, 4))] += sphere_volume(s.radius);
    for (std::int32_t c = 0; c < 64; ++c)
        EXPECT_NEAR(m.sums.solid_volume[c], expected[static_cast<std::size_t>(c)], 1e-14);
}

TEST(ExactOverlap, SphereAcrossAFaceIsCutInCaps)
{
    PolyMesh const mesh(hexahedra(3, {1, 1, 1}).mesh());
    double const r = 0.3;
    for (double const psi : {-0.9, -0.3, 0.0, 0.5})
    {
        auto const w = Mapped(mesh, method("exact"), {{{2 + psi * r, 1.5, 1.45}, r}}).weights();
        ASSERT_EQ(w.size(), 2u);
        EXPECT_NEAR(w.at(1 + 3 * (1 + 3)), (1 - psi) * (1 - psi) * (2 + psi) / 4, 1e-13) << psi;
        EXPECT_NEAR(w.at(2 + 3 * (1 + 3)), (1 + psi) * (1 + psi) * (2 - psi) / 4, 1e-13) << psi;
    }
}

TEST(ExactOverlap, CellsAcrossACornerHaveTheirPart)
{
    PolyMesh const mesh(hexahedra(4, {1, 1, 1}).mesh());
    auto const w = Mapped(mesh, method("exact"), {{{2, 2, 2}, 0.9}}).weights();
    ASSERT_EQ(w.size(), 8u);
    for (auto const& [cell, weight] : w)
        EXPECT_NEAR(weight, 0.125, 1e-14);
}

TEST(ExactOverlap, WhatIsBeyondAWallIsSharedByTheCellsInside)
{
    PolyMesh const mesh(hexahedra(3, {1, 1, 1}).mesh());
    double const r = 0.3;
    auto const w = Mapped(mesh, method("exact"), {{{0.1, 2, 1.5}, r}}).weights();
    ASSERT_EQ(w.size(), 2u);
    for (auto const& [cell, weight] : w)
        EXPECT_NEAR(weight, 0.5, 1e-14);
}

TEST(ExactOverlap, LargeParticleFillsCellsToTheBrim)
{
    PolyMesh const mesh(hexahedra(9, {1, 1, 1}).mesh());
    Mapped const m(mesh, method("exact"), {{{4.5, 4.5, 4.5}, 3}});
    EXPECT_NEAR(m.sums.solid_volume[4 + 9 * (4 + 9 * 4)], 1, 1e-12);
    EXPECT_NEAR(m.sums.solid_volume[5 + 9 * (3 + 9 * 4)], 1, 1e-12);
    EXPECT_EQ(m.sums.solid_volume[0], 0);
}

TEST(DividedVolume, IsACountOfPoints)
{
    PolyMesh const mesh(hexahedra(4, {1, 1, 1}).mesh());
    MappingSettings settings = method("divided");
    Vec3 const x(1.93, 1.62, 2.31);
    double const r = 0.8;
    std::map<std::int32_t, double> expected;
    auto const count = [&](Vec3 const& p) { expected[cube_of(p, 4)] += 1.0 / 29; };
    count(x);
    // Shells of 14 parts each: between the radii (1/29)^(1/3), (15/29)^(1/3) and 1, at their mean radii.
    for (double const s : {0.627568, 0.908551})
    {
        for (int axis = 0; axis < 3; ++axis)
            for (double const side : {-1.0, 1.0})
                count(x + side * s * r * Vec3::Unit(axis));
        for (int k = 0; k < 8; ++k)
            count(x + s * r / std::sqrt(3.0) * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
    }
    auto const w = Mapped(mesh, settings, {{x, r}}).weights();
    ASSERT_EQ(w.size(), expected.size());
    for (auto const& [cell, weight] : expected)
        EXPECT_NEAR(w.at(cell), weight, 1e-14);
}

TEST(DividedVolume, ManyPointsAreTheExactOverlap)
{
    PolyMesh const mesh(hexahedra(4, {1, 1, 1}).mesh());
    MappingSettings settings = method("divided");
    settings.points = 5000;
    for (Vec3 const& x : {Vec3(1.93, 1.62, 2.31), Vec3(2.2, 2.1, 1.9)})
    {
        auto const w = Mapped(mesh, settings, {{x, 0.8}}).weights();
        auto const exact = Mapped(mesh, method("exact"), {{x, 0.8}}).weights();
        // Points evenly spread: better than the 1/sqrt(5000) = 0.014 of random ones.
        for (auto const& [cell, weight] : exact)
            EXPECT_NEAR(w.contains(cell) ? w.at(cell) : 0, weight, 0.004) << cell;
    }
}

TEST(FaceSoftIntersection, IsTheProductOfCaps)
{
    int const n = 5;
    PolyMesh const mesh(hexahedra(n, {1, 1, 1}).mesh());
    Vec3 const x(2.8, 1.9, 2.4);
    double const r = 0.45;
    // On a lattice the weights are products of caps along the three axes.
    auto const cap = [&](double psi)
    {
        double const s = std::clamp(psi, -1.0, 1.0);
        return (1 - s) * (1 - s) * (2 + s) / 4;
    };
    std::map<std::int32_t, double> expected;
    double total = 0;
    for (int i = 1; i < 4; ++i)
        for (int j = 1; j < 4; ++j)
            for (int k = 1; k < 4; ++k)
            {
                Vec3 const low(i, j, k);
                double product = 1;
                for (int axis = 0; axis < 3; ++axis)
                    product *= cap((low[axis] - x[axis]) / r) * cap((x[axis] - low[axis] - 1) / r);
                if (product > 0) expected[i + n * (j + n * k)] = product;
                total += product;
            }
    auto const w = Mapped(mesh, method("fbsi"), {{x, r}}).weights();
    ASSERT_EQ(w.size(), expected.size());
    for (auto const& [cell, share] : expected)
        EXPECT_NEAR(w.at(cell), share / total, 1e-14) << cell;
}

TEST(FaceSoftIntersection, WallsTakeNothing)
{
    PolyMesh const mesh(hexahedra(3, {1, 1, 1}).mesh());
    auto const w = Mapped(mesh, method("fbsi"), {{{0.05, 1.5, 1.4}, 0.3}}).weights();
    ASSERT_EQ(w.size(), 1u);
    EXPECT_EQ(w.at(3 * (1 + 3)), 1);
}

TEST(GimFixed, IsTheIntegralWithOneCoefficient)
{
    PolyMesh const mesh(hexahedra(7, {1, 1, 1}).mesh());
    Vec3 const x(3.6, 3.45, 3.2);
    double const r = 0.21;
    MappingSettings settings = method("gim-fixed");
    settings.coefficient = 0.43;
    for (bool const tables : {true, false})
    {
        // A sphere as large as a cell, far away and behind in memory, makes the scene one without tables.
        std::vector<Sphere> spheres{{x, r}};
        if (!tables) spheres.push_back({{6.4, 6.4, 6.4}, std::cbrt(3 / (4 * M_PI))});
        Mapped const m(mesh, settings, spheres);
        auto const& rows = m.mapper.layers();
        std::int32_t const own = cube_of(x, 7);
        std::vector<double> expected;
        double total = 0;
        for (auto k = rows.offsets[own]; k < rows.offsets[own + 1]; ++k)
        {
            expected.push_back(
                GaussianIntegral{r, -std::log(sphere_volume(r)), 0.43}((x - mesh.centroid(rows.cells[k])).norm()));
            total += expected.back();
        }
        for (std::size_t k = 0; k < expected.size(); ++k)
            EXPECT_NEAR(m.mapper.weights()[static_cast<std::int64_t>(k)], expected[k] / total,
                        2 * GaussianTables::error_bound)
                << k;
    }
}

TEST(MakeMethod, UnknownNameIsRefusedWithThoseThatExist)
{
    PolyMesh const mesh(hexahedra(1, {1, 1, 1}).mesh());
    try
    {
        Mapper const mapper(serial, mesh, method("voodoo"));
        FAIL() << "there is no such method";
    }
    catch (UserError const& error)
    {
        EXPECT_NE(std::string(error.what()).find("\"voodoo\""), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("fbsi"), std::string::npos);
    }
}

TEST(NearbyCells, AreThoseWithinTheReachInBothDirections)
{
    PolyMesh const mesh(voronoi_cells(4, {1, 1, 1}).mesh());
    auto const boxes = cell_boxes(mesh);
    for (double const reach : {0.0, 0.07, 0.3, 2.0})
    {
        CellRows const rows = nearby_cells(boxes, reach);
        for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        {
            std::vector<std::int32_t> expected{c};
            for (std::int32_t other = 0; other < mesh.cell_count(); ++other)
                if (other != c && boxes[other].distance2(boxes[c]) <= reach * reach) expected.push_back(other);
            std::vector<std::int32_t> const row(rows.cells.host().begin() + rows.offsets[c],
                                                rows.cells.host().begin() + rows.offsets[c + 1]);
            ASSERT_EQ(row, expected) << reach;
        }
    }
}

}  // namespace

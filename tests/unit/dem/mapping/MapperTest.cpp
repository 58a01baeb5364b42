// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/Mapper.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "core/Error.hpp"
#include "mapping/GaussianIntegral.hpp"
#include "mapping/GaussianTable.hpp"

namespace
{

using gimdem::Mapper;
using gimdem::PolyMesh;
using gimdem::Vec3;
using namespace gimdem::test;

gimdem::exec::Buffer<std::uint8_t> wall_faces(PolyMesh const& mesh)
{
    gimdem::exec::Buffer<std::uint8_t> faces(mesh.face_count());
    faces.fill(0);
    for (auto const& patch : mesh.topology().patches)
        for (auto f = patch.start_face; f < patch.start_face + patch.face_count; ++f)
            faces[f] = patch.kind == gimdem::coupling::PatchKind::wall;
    return faces;
}

struct Mapping
{
    Mapping(PolyMesh const& mesh, gimdem::ParticleState const& particles, gimdem::exec::Execution execution = serial)
        : mapper(execution, mesh)
    {
        mapper.locate(particles, wall_faces(mesh));
        mapper.compute_weights(particles);
        gimdem::exec::Buffer<gimdem::Impulse> impulses(particles.count());
        for (std::int64_t p = 0; p < particles.count(); ++p)
            impulses[p] = {gimdem::Quad::of(1e-6 * Vec3(std::sin(p), std::cos(p), 0.1), 1e-7 * double(p % 7))};
        mapper.sum_into_cells(particles, impulses, sums);
        for (auto const& impulse : impulses.host())
            given += impulse.drag.xyz();
    }

    Mapper mapper;
    gimdem::CellSums sums;
    Vec3 given = Vec3::Zero();
};

TEST(Mapper, KeepsVolumeAndMomentumToRounding)
{
    PolyMesh const mesh(BoxMesh::make({9, 7, 8}, {1, 0.8, 0.9}));
    // From a tenth of a cell to twice its size, some beyond the walls by a part of their radius.
    auto const particles = particles_of(random_spheres(3000, {0, 0, 0}, {1, 0.8, 0.9}, 0.01, 0.12));
    Mapping const m(mesh, particles);
    double solid = 0, expected = 0;
    Vec3 taken = Vec3::Zero();
    for (double const v : m.sums.solid_volume.host())
        solid += v;
    for (auto const& d : m.sums.drag.host())
        taken += d.xyz();
    for (std::int64_t p = 0; p < particles.count(); ++p)
        expected += particles.volume(p);
    // 3000 particles on 25 cells each: sums of 75,000 terms, random rounding.
    EXPECT_NEAR(solid / expected, 1, 1e-13);
    EXPECT_LT((taken - m.given).norm(), 1e-13 * 3000 * 1e-6);
    EXPECT_GT(solid, 0.1);
}

TEST(Mapper, WeightsAreTheNormalisedSharedIntegrals)
{
    PolyMesh const mesh(BoxMesh::make({7, 7, 7}, {7, 7, 7}));
    Vec3 const x(3.6, 3.45, 3.2);
    double const r = 0.21;
    auto const particles = particles_of({{x, r}});
    Mapping const m(mesh, particles);

    double const log_ratio = -std::log(gimdem::sphere_volume(r));
    double total = 0;
    std::vector<double> expected;
    auto const& layers = m.mapper.layers();
    std::int32_t const own = 3 + 7 * (3 + 7 * 3);
    for (auto k = layers.offsets[own]; k < layers.offsets[own + 1]; ++k)
    {
        double const mu = (x - mesh.centroid(layers.cells[k])).norm();
        expected.push_back(gimdem::GaussianIntegral{r, log_ratio, gimdem::tuned_coefficient(log_ratio)}(mu));
        total += expected.back();
    }
    ASSERT_EQ(m.mapper.weights().size(), 25);
    for (std::int64_t k = 0; k < 25; ++k)
        EXPECT_NEAR(m.mapper.weights()[k], expected[static_cast<std::size_t>(k)] / total,
                    2 * gimdem::GaussianTables::error_bound)
            << k;
    EXPECT_GT(m.mapper.weights()[0], 0.5);  // its own cell, the nearest one
}

TEST(Mapper, ParticleOnACellCentreAndEqualVolumesAreFinite)
{
    PolyMesh const mesh(BoxMesh::make({5, 5, 5}, {5, 5, 5}));
    double const equal_radius = std::cbrt(3 / (4 * M_PI));
    auto const particles =
        particles_of({{{2.5, 2.5, 2.5}, equal_radius}, {{2.5, 2.5, 2.5}, 0.1}, {{2.5, 2.5, 2.5}, 2.0}});
    Mapping const m(mesh, particles);
    for (double const w : m.mapper.weights().host())
    {
        EXPECT_TRUE(std::isfinite(w));
        EXPECT_GE(w, 0);
        EXPECT_LE(w, 1);
    }
}

TEST(Mapper, LoneCellTakesAll)
{
    PolyMesh const mesh(BoxMesh::make({1, 1, 1}, {1, 1, 1}));
    auto const particles = particles_of({{{0.3, 0.9, 0.5}, 0.1}, {{0.5, 0.5, 0.5}, 0.4}});
    Mapping const m(mesh, particles);
    EXPECT_EQ(m.mapper.weights()[0], 1);
    EXPECT_EQ(m.mapper.weights()[1], 1);
    EXPECT_DOUBLE_EQ(m.sums.solid_volume[0], particles.volume(0) + particles.volume(1));
}

TEST(Mapper, ThreadsDoNotChangeABit)
{
    PolyMesh const mesh(BoxMesh::make({9, 7, 8}, {1, 0.8, 0.9}));
    auto const particles = particles_of(random_spheres(2000, {0, 0, 0}, {1, 0.8, 0.9}, 0.01, 0.06));
    Mapping const one(mesh, particles);
    Mapping const three(mesh, particles, {gimdem::exec::Backend::openmp, 3});
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        EXPECT_EQ(one.sums.solid_volume[c], three.sums.solid_volume[c]);
        EXPECT_EQ(one.sums.drag[c].xyz(), three.sums.drag[c].xyz());
    }
}

TEST(Mapper, ParticleThatSankIntoAWallIsNamed)
{
    PolyMesh const mesh(BoxMesh::make({3, 3, 3}, {1, 1, 1}));
    auto const message = [&](Vec3 const& x) -> std::string
    {
        try
        {
            Mapping const m(mesh, particles_of({{{0.5, 0.5, 0.5}, 0.1}, {x, 0.1}}));
            return "";
        }
        catch (gimdem::UserError const& error)
        {
            return error.what();
        }
    };
    EXPECT_EQ(message({-0.05, 0.5, 0.5}), "");  // sunk into a wall by less than its radius
    EXPECT_NE(message({-0.15, 0.5, 0.5}).find("particle 1"), std::string::npos);
    EXPECT_NE(message({-0.15, 0.5, 0.5}).find("outside the mesh"), std::string::npos);
}

TEST(Mapper, ParticleThatLeftThroughAnOpenPatchIsListedAndMappedOnceMore)
{
    PolyMesh const mesh(BoxMesh::make({3, 3, 3}, {1, 1, 1}));
    Mapping const m(mesh, particles_of({{{0.5, 0.5, 0.5}, 0.1}, {{0.5, 0.5, 1.01}, 0.1}}));
    ASSERT_EQ(m.mapper.left().size(), 1u);
    EXPECT_EQ(m.mapper.left()[0].particle, 1);
    gimdem::coupling::Patch const* const top = mesh.find_patch("top");
    EXPECT_GE(m.mapper.left()[0].face, top->start_face);
    EXPECT_LT(m.mapper.left()[0].face, top->start_face + top->face_count);
    double solid = 0;
    for (double const v : m.sums.solid_volume.host())
        solid += v;
    EXPECT_NEAR(solid, 2 * gimdem::sphere_volume(0.1), 1e-15);  // rounding
}

}  // namespace

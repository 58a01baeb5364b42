// SPDX-License-Identifier: BSD-3-Clause
#include "output/VtkParticles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "VtkFile.hpp"

namespace
{

using namespace gimdem::test;
using gimdem::output::write_vtk_particles;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(VtkParticles, StateReadsBackAsWritten)
{
    Folder const folder;
    std::vector<double> const position = {0.1, 0.2, 0.3, 1, 2, 3};
    std::vector<double> const radius = {7.725e-4, 1e-3};
    std::vector<double> const velocity = {0, 0, -1, 0.5, 0, 0};
    std::vector<double> const angular_velocity = {10, 0, 0, 0, 20, 0};
    std::vector<std::int64_t> const id = {5'000'000'000, -1};

    write_vtk_particles(folder / "a.vtp", {0.25, position, radius, velocity, angular_velocity, id});

    VtkFile const file(folder / "a.vtp");
    EXPECT_THAT(file.head(), HasSubstr("NumberOfPoints=\"2\" NumberOfVerts=\"2\""));
    EXPECT_THAT(file.array<float>("Points"), ElementsAre(0.1f, 0.2f, 0.3f, 1, 2, 3));
    EXPECT_THAT(file.array<float>("radius"), ElementsAre(7.725e-4f, 1e-3f));
    EXPECT_THAT(file.array<float>("velocity"), ElementsAre(0, 0, -1, 0.5f, 0, 0));
    EXPECT_THAT(file.array<float>("angular_velocity"), ElementsAre(10, 0, 0, 0, 20, 0));
    EXPECT_THAT(file.array<std::int64_t>("id"), ElementsAre(5'000'000'000, -1));
    EXPECT_THAT(file.array<double>("TimeValue"), ElementsAre(0.25));
}

TEST(VtkParticles, EachPointIsAVertex)
{
    Folder const folder;
    std::vector<double> const position(9);

    write_vtk_particles(folder / "a.vtp", {0, position, {}, {}, {}, {}});

    VtkFile const file(folder / "a.vtp");
    EXPECT_THAT(file.array<std::int64_t>("connectivity"), ElementsAre(0, 1, 2));
    EXPECT_THAT(file.array<std::int64_t>("offsets"), ElementsAre(1, 2, 3));
    EXPECT_FALSE(file.has("radius"));
}

TEST(VtkParticles, NoParticlesAreAFileToo)
{
    Folder const folder;

    write_vtk_particles(folder / "a.vtp", {});

    EXPECT_TRUE(VtkFile(folder / "a.vtp").array<float>("Points").empty());
}

TEST(VtkParticles, ArraysOfUnequalLengthAreRefused)
{
    Folder const folder;
    std::vector<double> const position(6);
    std::vector<double> const radius(3);

    EXPECT_THROW(write_vtk_particles(folder / "a.vtp", {0, position, radius, {}, {}, {}}), std::invalid_argument);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.vtp"));
}

}  // namespace

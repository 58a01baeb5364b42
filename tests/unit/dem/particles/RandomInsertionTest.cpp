// SPDX-License-Identifier: BSD-3-Clause
#include "particles/RandomInsertion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "TestCase.hpp"
#include "core/Error.hpp"
#include "particles/Insertion.hpp"

namespace
{

using gimdem::InsertionSettings;
using gimdem::ParticleState;
using gimdem::Vec3;

InsertionSettings in_box(double diameter, std::int64_t count)
{
    InsertionSettings settings;
    settings.material = "bead";
    settings.arrangement = "random";
    settings.diameter = diameter;
    settings.count = count;
    settings.box = {{{0, 0, 0}, {0.02, 0.02, 0.03}}};
    settings.seed = 4;
    return settings;
}

ParticleState insert(std::vector<InsertionSettings> const& insertion)
{
    gimdem::Case settings = gimdem::test::bead_case();
    settings.insertion = insertion;
    return gimdem::insert_particles(settings, gimdem::Materials(settings));
}

/// The smallest gap between two particles and between a particle and the box [m]: by brute force.
double smallest_gap(ParticleState const& p)
{
    double gap = 1;
    for (std::int64_t i = 0; i < p.count(); ++i)
    {
        Vec3 const x = p.position[i].xyz();
        double const r = p.position[i].w;
        gap = std::min({gap, x.minCoeff() - r, (Vec3(0.02, 0.02, 0.03) - x).minCoeff() - r});
        for (std::int64_t j = 0; j < i; ++j)
            gap = std::min(gap, (x - p.position[j].xyz()).norm() - r - p.position[j].w);
    }
    return gap;
}

std::string message_of(std::vector<InsertionSettings> const& insertion)
{
    try
    {
        insert(insertion);
        return "";
    }
    catch (gimdem::UserError const& error)
    {
        return error.what();
    }
}

TEST(RandomInsertion, FillsTheBoxWithoutOverlap)
{
    auto const particles = insert({in_box(1.5e-3, 1500)});
    EXPECT_EQ(particles.count(), 1500);  // 22 % solid
    EXPECT_GE(smallest_gap(particles), -1e-18);
}

TEST(RandomInsertion, SizesOfTenToOneAndEarlierParticlesDoNotOverlap)
{
    InsertionSettings small = in_box(0, 2000);
    small.sizes.emplace();
    small.sizes->distribution = "uniform";
    small.sizes->minimum = 4e-4;
    small.sizes->maximum = 4e-3;
    small.count = 150;
    InsertionSettings second = in_box(8e-4, 400);
    second.seed = 8;
    auto const particles = insert({small, second});
    EXPECT_EQ(particles.count(), 550);
    EXPECT_GE(smallest_gap(particles), -1e-18);
}

TEST(RandomInsertion, MassIsMetToHalfAParticle)
{
    InsertionSettings by_mass = in_box(0, 0);
    by_mass.mass = 2e-3;
    by_mass.sizes.emplace();
    by_mass.sizes->distribution = "uniform";
    by_mass.sizes->minimum = 1e-3;
    by_mass.sizes->maximum = 2e-3;
    auto const particles = insert({by_mass});
    double mass = 0;
    for (std::int64_t p = 0; p < particles.count(); ++p)
        mass += particles.mass(p);
    // Half of the largest particle.
    EXPECT_NEAR(mass, 2e-3, 0.5 * 1150 * gimdem::sphere_volume(1e-3));
}

TEST(RandomInsertion, SameSeedSameParticlesOtherSeedOthers)
{
    auto const a = insert({in_box(1.5e-3, 50)}), b = insert({in_box(1.5e-3, 50)});
    InsertionSettings other = in_box(1.5e-3, 50);
    other.seed = 5;
    auto const c = insert({other});
    EXPECT_EQ(std::memcmp(a.position.host().data(), b.position.host().data(), a.position.host().size_bytes()), 0);
    EXPECT_NE(a.position[0].x, c.position[0].x);
}

TEST(RandomInsertion, FullBoxTellsHowFarItGot)
{
    // Random sequential addition jams at a solid fraction of 0.38 (Torquato 2002): 5000 spheres would be 0.74.
    std::string const message = message_of({in_box(1.5e-3, 5000)});
    EXPECT_NE(message.find("of 5000 random particles only"), std::string::npos) << message;
    auto const at = message.find("the box is ");
    ASSERT_NE(at, std::string::npos) << message;
    double const percent = std::stod(message.substr(at + 11));
    EXPECT_GT(percent, 28);  // walls keep centres half a diameter away
    EXPECT_LT(percent, 38.4);
}

TEST(RandomInsertion, ThinBoxIsRefused)
{
    EXPECT_NE(message_of({in_box(0.021, 1)}).find("thinner"), std::string::npos);
}

/// A CSV file that lives as long as the test.
struct PositionsFile
{
    explicit PositionsFile(std::string const& text)
        : path(std::filesystem::temp_directory_path() / ("gimdem-positions-" + std::to_string(::getpid()) + ".csv"))
    {
        std::ofstream(path) << text;
    }
    ~PositionsFile() { std::filesystem::remove(path); }

    std::string message() const
    {
        InsertionSettings settings;
        settings.material = "bead";
        settings.arrangement = "file";
        settings.file = path;
        return message_of({settings});
    }
    std::filesystem::path path;
};

TEST(FileInsertion, BadNumbersAreRefusedWithTheirLine)
{
    EXPECT_EQ(PositionsFile("x,y,z,radius\n0,0,0,1e-3\n").message(), "");
    EXPECT_NE(PositionsFile("x,y,z,radius\n0,0,0,1e-3\n0,nan,0,1e-3\n").message().find(":3: \"nan\""),
              std::string::npos);
    EXPECT_NE(PositionsFile("x,y,z,radius\n0,0,0,0\n").message().find("radius 0 m"), std::string::npos);
    EXPECT_NE(PositionsFile("x,y,z,radius\n0,0,0,1e-110\n").message().find("no mass"), std::string::npos);
    EXPECT_NE(PositionsFile("x,y,z,radius\n0,0,0\n").message().find("3 numbers where the header names 4"),
              std::string::npos);
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
/// The engine on a device against the engine on the host, which other tests hold against closed forms.
#include "engine/device/DeviceDem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "DeviceBackends.hpp"
#include "DeviceScene.hpp"
#include "core/ContactLawNames.hpp"
#include "core/Error.hpp"
#include "engine/Settling.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

class DeviceDemTest : public OnDevice
{
};

// The host takes eight pairs at once and its own square root, which may be off by a digit; sums are in one order. A
// contact turns 1e-16 of the position into 1e-16 r / overlap = 1e-13 of the force, and steps add up.
constexpr double rounding = 1e-10;

// Of laws in single precision: 6e-8 in each of some ten operations on a force, which steps add up.
constexpr double single_rounding = 1e-5;

/// Both after some steps; lists are built anew in between.
void compare(exec::Execution const& device, Case const& settings, int along = 6, double ratio = 1,
             std::vector<std::int32_t> const& materials = {}, int steps = 40)
{
    double const tolerance = settings.dem.precision == "mixed" ? single_rounding : rounding;
    DeviceScene host(serial, settings, along, ratio, materials), there(device, settings, along, ratio, materials);
    expect_same_within(host.seen(), there.seen(), tolerance);

    host.run(steps);
    there.run(steps);

    EXPECT_EQ(host.system.rebuilds(), there.system.rebuilds());
    std::int64_t touching = 0;
    auto const of_pairs = touches_of_pairs(host.seen().neighbors());
    for (auto const touches : of_pairs.host())
        touching += touches;
    EXPECT_GT(touching, 20);
    expect_same_within(host.seen(), there.seen(), tolerance);
    // Of forces of both signs.
    Vec3 const impulse = host.system.wall_impulse();
    EXPECT_LT((impulse - there.system.wall_impulse()).norm(), 100 * tolerance * impulse.norm());
}

TEST_P(DeviceDemTest, MovesOneSizeOfSpheresAsTheHostDoes)
{
    compare(GetParam(), DeviceScene::falling());
}

TEST_P(DeviceDemTest, MovesSpheresOfManySizesAsTheHostDoes)
{
    Case settings = DeviceScene::falling();
    settings.dem.skin = 0.5;
    compare(GetParam(), settings, 6, 5);
}

/// With a value for all that one of the laws may need.
Case with_laws(std::string_view force, std::string_view rolling, std::string_view cohesion)
{
    Case settings = DeviceScene::falling();
    settings.dem.contact_law = force;
    settings.dem.rolling_friction = rolling;
    settings.dem.cohesion = cohesion;
    auto& pair = settings.contacts[0];
    pair.normal_stiffness = 50;
    pair.rolling_friction = 0.1;
    pair.rolling_damping = 0.3;
    pair.cohesion_energy_density = 2e3;
    return settings;
}

TEST_P(DeviceDemTest, HasAllContactLaws)
{
    for (auto const force : force_law_names)
        for (auto const rolling : rolling_law_names)
            for (auto const cohesion : cohesion_law_names)
            {
                SCOPED_TRACE(std::string(force) + " " + std::string(rolling) + " " + std::string(cohesion));
                compare(GetParam(), with_laws(force, rolling, cohesion), 4, 1.5, {}, 20);
            }
}

TEST_P(DeviceDemTest, ComputesLawsInSinglePrecisionAsTheHostDoes)
{
    struct
    {
        char const *force, *rolling, *cohesion;
    } const choices[] = {
        {"hertz-mindlin", "none", "none"}, {"hertz-mindlin", "epsd", "sjkr"}, {"linear", "cdt", "none"}};
    for (auto const& [force, rolling, cohesion] : choices)
    {
        SCOPED_TRACE(std::string(force) + " " + rolling + " " + cohesion);
        Case settings = with_laws(force, rolling, cohesion);
        settings.dem.precision = "mixed";
        compare(GetParam(), settings, 5, 1.5, {}, 20);
    }
}

TEST_P(DeviceDemTest, SinglePrecisionIsNotDouble)
{
    Case settings = DeviceScene::falling();
    DeviceScene precise(GetParam(), settings, 5, 1.5);
    settings.dem.precision = "mixed";
    DeviceScene mixed(GetParam(), settings, 5, 1.5);
    precise.run(20);
    mixed.run(20);
    double worst = 0, largest = 0;
    for (std::int64_t i = 0; i < precise.seen().particles().count(); ++i)
    {
        Vec3 const f = precise.seen().particles().force[i].xyz();
        worst = std::max(worst, (f - mixed.seen().particles().force[i].xyz()).norm());
        largest = std::max(largest, f.norm());
    }
    EXPECT_GT(worst, 1e-9 * largest);
    EXPECT_LT(worst, single_rounding * largest);
}

TEST_P(DeviceDemTest, KnowsTheMaterialsOfAPair)
{
    Case settings = DeviceScene::falling();
    settings.materials.push_back({"steel", 1150, 4e5, 0.3});
    settings.contacts.push_back({{"bead", "steel"}, 0.5, 0.1});
    settings.contacts.push_back({{"steel", "steel"}, 0.95, 0.6});
    settings.walls.material = "steel";
    compare(GetParam(), settings, 6, 1, {0, 1, 1});
}

TEST_P(DeviceDemTest, GoesRoundPeriodicBorders)
{
    Case settings = DeviceScene::falling();
    settings.domain.periodic = {true, true, false};
    settings.domain.box = {{{0, 0, 0}, {6 * 2.1e-3, 6 * 2.1e-3, 1}}};
    // Open sides would be walls otherwise: spheres are on their way through them.
    settings.dem.gravity = {0, 0, -9.81};
    compare(GetParam(), settings, 6, 2);
}

TEST_P(DeviceDemTest, IsPushedByWallsThatMove)
{
    Case settings = DeviceScene::falling();
    WallItemSettings plate;
    plate.name = "plate";
    plate.normal = {0, 0, 1};
    plate.point = {0, 0, 1e-4};
    plate.vibration = WallVibrationSettings{{0, 0, 1}, 5e-4, 100, 0};
    WallItemSettings drum;
    drum.name = "drum";
    drum.shape = "cylinder";
    drum.axis = {0, 1, 0};
    drum.point = {6.3e-3, 0, 6.3e-3};
    drum.radius = 6.2e-3;
    drum.inside = true;
    drum.rotation = WallRotationSettings{{0, 1, 0}, {6.3e-3, 0, 6.3e-3}, 20};
    settings.wall = {plate, drum};
    compare(GetParam(), settings);
}

TEST_P(DeviceDemTest, GivesTheSameBitsInAnyOrder)
{
    DeviceScene one(GetParam(), DeviceScene::falling(), 5, 3), other(in_another_order(), DeviceScene::falling(), 5, 3);

    one.run(200);
    other.run(200);

    EXPECT_GT(one.system.rebuilds(), 1);
    expect_same_bits(one.seen(), other.seen());
}

TEST_P(DeviceDemTest, LooksOfTheHostChangeNothing)
{
    DeviceScene one(GetParam(), DeviceScene::falling(), 4), other(GetParam(), DeviceScene::falling(), 4);

    one.run(100);
    for (int k = 0; k < 10; ++k)
    {
        other.run(10);
        other.system.particles();  // could have been changed: all goes back to the device
    }

    expect_same_bits(one.seen(), other.seen());
}

TEST_P(DeviceDemTest, TakesWhatTheHostChanges)
{
    DeviceScene scene(GetParam(), DeviceScene::falling(), 3);
    for (auto& v : scene.system.particles().velocity.host())
        v.set_xyz({0, 0, 1});

    scene.run(1, 1e-7);

    for (auto const& v : scene.seen().particles().velocity.host())
        EXPECT_NEAR(v.z, 1, 1e-3);
}

TEST_P(DeviceDemTest, LosesAndGainsParticlesAsTheHostDoes)
{
    DeviceScene host(serial, DeviceScene::falling(), 5), there(GetParam(), DeviceScene::falling(), 5);
    for (DeviceScene* const scene : {&host, &there})
    {
        scene->run(20);
        std::vector<std::int32_t> cause(125, -1);
        for (std::size_t i = 0; i < cause.size(); i += 7)
            cause[i] = 0;
        EXPECT_EQ(scene->system.remove(cause, {"a test"}), 18);
        scene->run(10);
        scene->system.insert(particles_of({{{4e-3, 5e-3, 6e-3}, 8e-4}, {{7e-3, 2e-3, 1e-3}, 5e-4, {0, 0, 0.1}}}));
        scene->run(20);
    }

    EXPECT_EQ(there.seen().particles().count(), 109);
    expect_same_within(host.seen(), there.seen(), rounding);
}

TEST_P(DeviceDemTest, CanLoseThemAll)
{
    DeviceScene scene(GetParam(), DeviceScene::falling(), 2);
    scene.run(3);

    EXPECT_EQ(scene.system.remove(std::vector<std::int32_t>(8, 0), {"a test"}), 8);
    scene.run(3);
    scene.system.insert(particles_of({{{1e-3, 1e-3, 1e-3}, 9e-4}}));
    scene.run(3);

    EXPECT_EQ(scene.seen().particles().count(), 1);
    EXPECT_LT(scene.seen().particles().velocity[0].z, 0);
}

TEST_P(DeviceDemTest, AllocatesNothingInASettledStep)
{
    DeviceScene scene(GetParam(), DeviceScene::falling(), 4);
    scene.run(150);
    std::int64_t const before = scene.system.device()->allocations(), rebuilds = scene.system.rebuilds();

    scene.run(100);

    EXPECT_GT(scene.system.rebuilds(), rebuilds);
    EXPECT_EQ(scene.system.device()->allocations(), before);
}

TEST_P(DeviceDemTest, NamesTheParticleThatDiverged)
{
    DeviceScene scene(GetParam(), DeviceScene::falling(), 3);
    auto& particles = scene.system.particles();
    particles.velocity[5].x = NAN;
    std::string const number = std::to_string(particles.id[5]);
    try
    {
        scene.run(1);
        FAIL() << "a particle at NaN went unnoticed";
    }
    catch (UserError const& error)
    {
        EXPECT_NE(std::string(error.what()).find("particle " + number + " "), std::string::npos) << error.what();
    }
}

TEST_P(DeviceDemTest, ABedSettlesAsItDoesOnTheHost)
{
    DeviceScene host(serial), there(GetParam());

    host.run(1200, 4e-5);
    there.run(1200, 4e-5);

    // In units of the fall over a radius: no longer in free fall, as 48 ms are worth 11 radii.
    double const weight = 1150 * sphere_volume(1e-3) * 9.81 * 1e-3;
    double const energy = mean_kinetic_energy(serial, host.seen().particles()) / weight;
    EXPECT_LT(energy, 0.1);
    EXPECT_NEAR(mean_kinetic_energy(serial, there.seen().particles()) / weight, energy, 1e-6);
    // A bed that dissipates forgets its roundings: 1e-11 apart here; 1e-6 of the box is a four-hundredth of a radius.
    EXPECT_LT(relative_difference(host.seen().particles().position, there.seen().particles().position), 1e-6);
}

GIMDEM_ON_DEVICES(DeviceDemTest);

// Too many for an interpreter of GPU code: particles of two blocks of the host's sums, and several blocks of scan and
// sort.
TEST(DeviceDem, SumsOverBlocksInTheOrderOfTheHost)
{
    compare(guarded(3), DeviceScene::falling(), 11);
}

TEST(DeviceDem, SaysWhatIsMissingWhereThereIsNoCuda)
{
    if (exec::cuda_is_there()) GTEST_SKIP() << "there is a GPU";
    try
    {
        DeviceScene scene(gpu(exec::Sorting::library), DeviceScene::falling(), 2);
        FAIL() << "a GPU that is not there";
    }
    catch (UserError const& error)
    {
        EXPECT_NE(std::string(error.what()).find("--device cpu"), std::string::npos) << error.what();
    }
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "SameBits.hpp"
#include "contact/ContactLaws.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "ContactScene.hpp"
#include "LawScenes.hpp"
#include "contact/ContactModel.hpp"
#include "core/Error.hpp"
#include "engine/Settling.hpp"
#include "engine/StartChecks.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;
using exec::Octet;

std::vector<Sphere> layers()
{
    std::vector<Sphere> spheres;
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i)
                spheres.push_back({2.3e-3 * Vec3(i, j, k) + Vec3::Constant(1.2e-3) + 1e-4 * Vec3(j % 3, k % 3, i % 3),
                                   8e-4 + 1e-4 * ((i + j + k) % 4),
                                   {0.3 * (k % 2), 0.1, -0.2},
                                   {50, -30, i * 20.0}});
    return spheres;
}
constexpr BoxMesh::Lengths box{0.01, 0.01, 0.012};

bool same_motion(DemSystem const& a, DemSystem const& b)
{
    return same_bits(a.particles().id, b.particles().id) && same_bits(a.particles().position, b.particles().position) &&
           same_bits(a.particles().velocity, b.particles().velocity) &&
           same_bits(a.particles().angular_velocity, b.particles().angular_velocity);
}

double& lane_of(Octet& values, int lane)
{
    return values[lane];
}
void put(Vector3<Octet>& to, Vector3<double> const& from, int lane)
{
    lane_of(to.x, lane) = from.x;
    lane_of(to.y, lane) = from.y;
    lane_of(to.z, lane) = from.z;
}
Vector3<double> get(Vector3<Octet> const& from, int lane)
{
    return {from.x[lane], from.y[lane], from.z[lane]};
}
/// Roots of eight numbers may differ from the root of one in the last bits, and products are added with one rounding
/// instead of two: some roundings, some cancellation.
void expect_equal(Vector3<double> const& a, Vector3<double> const& b)
{
    Vector3<double> const off = a - b;
    EXPECT_LE(std::sqrt(off.dot(off)), 1e-13 * std::sqrt(b.dot(b)));
}

TEST(ContactLaws, EightLanesGiveWhatEachGivesAlone)
{
    for (Case const& settings : all_laws())
    {
        SCOPED_TRACE(name_of_laws(settings));
        Materials const materials(settings);
        ContactModel(materials).visit(
            [&]<class Law>(LawTable<Law> const& table)
            {
                auto const constants = table.constants[0];
                std::int32_t const rows[exec::octet] = {};
                ContactGeometry<Octet> eight;
                ContactSprings<Octet> springs;
                for (int lane = 0; lane < exec::octet; ++lane)
                {
                    auto const one = contact_of(100 * lane);
                    put(eight.normal, one.normal, lane);
                    put(eight.velocity, one.velocity, lane);
                    put(eight.spin, one.spin, lane);
                    eight.overlap[lane] = one.overlap;
                    eight.radius_eff[lane] = one.radius_eff;
                    eight.mass_eff[lane] = one.mass_eff;
                    eight.inverse_inertia[lane] = one.inverse_inertia;
                    eight.per_distance[lane] = one.per_distance;
                    // From far below the limits to far above; none along the normal, whose turned direction is noise.
                    put(springs.tangential, noisy(7 * lane + 1, 1e-9 * std::pow(10, lane)), lane);
                    put(springs.rolling, noisy(9 * lane + 1, 1e-12 * std::pow(10, lane)), lane);
                }
                auto same_for_all = springs, one_by_one = springs;
                auto const out = Law::template apply<Octet>(constants, 1e-5, eight, same_for_all);
                Law::template apply<Octet>(lanes_of<Law, Octet>(table.constants.view().data, rows), 1e-5, eight,
                                           one_by_one);
                for (int lane = 0; lane < exec::octet; ++lane)
                {
                    ContactSprings<double> alone{get(springs.tangential, lane), get(springs.rolling, lane)};
                    auto const expected = Law::template apply<double>(constants, 1e-5, contact_of(100 * lane), alone);
                    expect_equal(get(out.force, lane), expected.force);
                    expect_equal(get(same_for_all.tangential, lane), alone.tangential);
                    expect_equal(get(one_by_one.tangential, lane), alone.tangential);
                    if constexpr (Law::rolls) expect_equal(get(out.rolling, lane), expected.rolling);
                    if constexpr (Law::has_rolling_spring) expect_equal(get(one_by_one.rolling, lane), alone.rolling);
                }
            });
    }
}

TEST(ContactLaws, MaterialsOfTheSameValuesAreOneMaterial)
{
    for (Case const& one : all_laws())
    {
        Case two = one;
        two.materials.push_back({"twin", 1150, 1.2e5, 0.33});
        for (auto const& pair : {std::array<std::string, 2>{"bead", "twin"}, {"twin", "twin"}})
        {
            two.contacts.push_back(one.contacts[0]);
            two.contacts.back().pair = pair;
        }
        std::vector<std::int32_t> material;
        for (int i = 0; i < 64; ++i)
            material.push_back(i % 2);
        ContactScene a(one, layers(), box), b(two, layers(), box, material);
        a.run(300, 2e-5);
        b.run(300, 2e-5);
        EXPECT_TRUE(same_motion(a.system, b.system)) << name_of_laws(one);
    }
}

TEST(ContactLaws, ThreadsAndARestartDoNotChangeABit)
{
    for (Case const& settings : all_laws())
    {
        auto const file = std::filesystem::temp_directory_path() / "gimdem-laws-test" / "state.h5";
        ContactScene one(settings, layers(), box), two(settings, layers(), box, {}, {exec::Backend::openmp, 2}),
            restarted(settings, layers(), box);
        one.run(300, 2e-5);
        two.run(300, 2e-5);
        EXPECT_TRUE(same_motion(one.system, two.system)) << name_of_laws(settings);

        write_state(file, "test", one.system, 0);
        read_state(file, "test", one.system);
        read_state(file, "test", restarted.system);
        one.run(200, 2e-5);
        restarted.run(200, 2e-5);
        EXPECT_TRUE(same_motion(one.system, restarted.system)) << name_of_laws(settings);
        EXPECT_GT(one.system.rebuilds(), 3);
        std::filesystem::remove_all(file.parent_path());
    }
}

TEST(ContactLaws, StateWithoutRollingSpringsIsRefusedWhereTheyAreNeeded)
{
    auto const file = std::filesystem::temp_directory_path() / "gimdem-laws-test-2" / "state.h5";
    Case settings = bead_case();
    ContactScene plain(settings, layers(), box);
    write_state(file, "test", plain.system, 0);
    settings.dem.rolling_friction = "epsd";
    ContactScene rolls(settings, layers(), box);
    EXPECT_THROW(read_state(file, "test", rolls.system), UserError);
    std::filesystem::remove_all(file.parent_path());
}

TEST(ContactLaws, EveryLawKeepsMomentumAndAngularMomentum)
{
    for (Case settings : all_laws())
    {
        settings.dem.gravity = {0, 0, 0};
        ContactScene scene(settings, {{{0.4, 0.5, 0.5}, 0.001, {0.3, 0.1, -0.05}, {20, -5, 3}},
                                      {{0.4028, 0.5003, 0.5002}, 0.002, {-0.2, 0, 0.1}, {-4, 8, 1}}});
        auto const total = [&]
        {
            Vec3 sum = Vec3::Zero(), turn = Vec3::Zero();
            auto const& s = scene.system.particles();
            for (std::int64_t i = 0; i < 2; ++i)
            {
                sum += s.mass(i) * s.velocity[i].xyz();
                turn += s.mass(i) * (s.position[i].xyz() - Vec3(0.4, 0.5, 0.5)).cross(s.velocity[i].xyz()) +
                        s.angular_velocity[i].xyz() / s.angular_velocity[i].w;
            }
            return std::pair(sum, turn);
        };
        auto const before = total();
        Vec3 const spin_before = scene.spin(0);
        scene.run(3000, 1e-6);
        auto const after = total();
        // Rounding of 3000 steps, and of positions near 0.5 m against levers of 3 mm.
        EXPECT_LT((after.first - before.first).norm(), 1e-12 * before.first.norm()) << name_of_laws(settings);
        EXPECT_LT((after.second - before.second).norm(), 1e-10 * before.second.norm()) << name_of_laws(settings);
        EXPECT_GT((scene.spin(0) - spin_before).norm(), 0.1) << name_of_laws(settings);
    }
}

TEST(ContactLaws, UnknownLawIsRefused)
{
    Case settings = bead_case();
    settings.dem.contact_law = "luding";
    EXPECT_THROW(ContactModel{Materials(settings)}, UserError);
}

TEST(StartChecks, LinearContactsLimitTheTimeStepByTheirDuration)
{
    Case settings = linear_case(1000, 0.9, 1150);
    settings.materials.push_back({"steel", 7800, 1e7, 0.3});
    settings.contacts.push_back({{"bead", "steel"}, 0.9, 0});
    settings.contacts.back().normal_stiffness = 4000;
    settings.walls.material = "steel";
    Materials const materials(settings);
    auto const particles = particles_of({{{0.5, 0.5, 0.5}, 1e-3}, {{0.2, 0.5, 0.5}, 5e-4}});
    double const light = 1150 * sphere_volume(5e-4);
    // Two of the light ones on 1000 N/m: m/2; one on the wall with 4000 N/m: m, which is shorter.
    double const expected = std::numbers::pi * std::sqrt(light / 4000);
    EXPECT_NEAR(shortest_linear_contact(settings, materials, particles), expected, 1e-12 * expected);
    settings.dem.time_step = 0.099 * expected;
    EXPECT_NO_THROW(check_time_step(settings, materials, particles));
    settings.dem.time_step = 0.101 * expected;
    EXPECT_THROW(check_time_step(settings, materials, particles), UserError);
}

}  // namespace

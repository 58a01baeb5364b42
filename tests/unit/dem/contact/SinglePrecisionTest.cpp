// SPDX-License-Identifier: BSD-3-Clause
/// Laws in single precision, precision = "mixed": what they lose against double, and what they must not lose.
#include <gtest/gtest.h>

#include <cmath>

#include "Figure.hpp"
#include "TestCase.hpp"
#include "contact/ContactModel.hpp"
#include "contact/Meeting.hpp"
#include "exec/Hexadecad.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;
using exec::Hexadecad;

/// A number in [-1, 1] that looks random.
double noise(int n)
{
    return std::sin(12.9898 * n + 78.233 * std::cos(4.1 * n));
}
Vector3<double> noisy(int n, double size)
{
    return {size * noise(n), size * noise(n + 1), size * noise(n + 2)};
}

/// A contact of beads in a bed: overlaps of 0.1 to 2 %, 0.1 m/s.
ContactGeometry<double> contact_of(int n)
{
    Vector3<double> const normal = noisy(n, 1);
    return {.normal = (1 / std::sqrt(normal.dot(normal))) * normal,
            .overlap = 1e-5 * (1.1 + noise(n + 10)),
            .velocity = noisy(n + 20, 0.1),
            .radius_eff = 1e-3 * (1.5 + noise(n + 30)),
            .mass_eff = 1e-6 * (1.5 + noise(n + 31)),
            .spin = noisy(n + 40, 30),
            .inverse_inertia = 1e12 * (1.5 + noise(n + 50)),
            .per_distance = 400};
}

void put(Vector3<Hexadecad>& to, Vector3<double> const& from, int lane)
{
    to.x[lane] = static_cast<float>(from.x);
    to.y[lane] = static_cast<float>(from.y);
    to.z[lane] = static_cast<float>(from.z);
}
Vector3<double> get(Vector3<Hexadecad> const& from, int lane)
{
    return {from.x[lane], from.y[lane], from.z[lane]};
}
double length(Vector3<double> const& v)
{
    return std::sqrt(v.dot(v));
}

std::vector<Case> all_laws()
{
    std::vector<Case> cases;
    for (auto const force : force_law_names)
        for (auto const rolling : rolling_law_names)
            for (auto const cohesion : cohesion_law_names)
            {
                Case settings = bead_case(0.6, 0.3);
                settings.dem.contact_law = force;
                settings.dem.rolling_friction = rolling;
                settings.dem.cohesion = cohesion;
                settings.contacts[0].normal_stiffness = 50;
                settings.contacts[0].rolling_friction = 0.2;
                settings.contacts[0].rolling_damping = 0.3;
                settings.contacts[0].cohesion_energy_density = 1000;
                cases.push_back(settings);
            }
    return cases;
}

TEST(SinglePrecision, SixteenLanesGiveWhatDoubleGives)
{
    double worst = 0;
    for (Case const& settings : all_laws())
    {
        SCOPED_TRACE(settings.dem.contact_law + ' ' + settings.dem.rolling_friction + ' ' + settings.dem.cohesion);
        ContactModel(Materials(settings))
            .visit(
                [&]<class Law>(LawTable<Law> const& table)
                {
                    ContactGeometry<Hexadecad> all;
                    ContactSprings<Hexadecad> springs;
                    for (int lane = 0; lane < Hexadecad::lanes; ++lane)
                    {
                        auto const one = contact_of(100 * lane);
                        put(all.normal, one.normal, lane);
                        put(all.velocity, one.velocity, lane);
                        put(all.spin, one.spin, lane);
                        all.overlap[lane] = static_cast<float>(one.overlap);
                        all.radius_eff[lane] = static_cast<float>(one.radius_eff);
                        all.mass_eff[lane] = static_cast<float>(one.mass_eff);
                        all.inverse_inertia[lane] = static_cast<float>(one.inverse_inertia);
                        all.per_distance[lane] = static_cast<float>(one.per_distance);
                        // From far below the limits to far above; one contact is new.
                        put(springs.tangential, noisy(7 * lane, lane == 0 ? 0 : 1e-9 * std::pow(3, lane)), lane);
                        put(springs.rolling, noisy(9 * lane, lane == 0 ? 0 : 1e-12 * std::pow(3, lane)), lane);
                    }
                    auto after = springs;
                    auto const out = Law::template apply<Hexadecad>(table.constants[0], 1e-5, all, after);
                    for (int lane = 0; lane < Hexadecad::lanes; ++lane)
                    {
                        ContactSprings<double> alone{get(springs.tangential, lane), get(springs.rolling, lane)};
                        auto const want =
                            Law::template apply<double>(table.constants[0], 1e-5, contact_of(100 * lane), alone);
                        auto const expect = [&](Vector3<double> const& got, Vector3<double> const& wanted, double scale)
                        {
                            double const off = length(got - wanted) / scale;
                            EXPECT_LT(off, 5e-5) << lane;
                            worst = std::max(worst, off);
                        };
                        // Of forces that cancel each other the scale is what they are made of.
                        double const push = length(want.force) + length(want.tangential) + std::abs(want.normal);
                        expect(get(out.force, lane), want.force, push);
                        expect(get(after.tangential, lane), alone.tangential,
                               length(alone.tangential) + 1e-5 * length(contact_of(100 * lane).velocity));
                        if constexpr (Law::rolls) expect(get(out.rolling, lane), want.rolling, length(want.rolling));
                    }
                });
    }
    figure("single_precision_worst_deviation_of_a_law", worst);
    // Sixty operations of 6e-8 each are below 4e-6; a spring that leans out of the plane of contact loses ten times
    // more when it is turned back, since only its part within the plane tells the direction. Below 1e-9 it would not
    // have been single precision.
    EXPECT_GT(worst, 1e-9);
}

TEST(SinglePrecision, SmallOverlapsKeepTheirDigits)
{
    using Plain = ContactLaw<HertzMindlinLaw>;
    double const r = 7.725e-4, reach = 2 * r;
    Encounter<Hexadecad> met;
    Vector3<double> const along{2.0 / 7, 3.0 / 7, 6.0 / 7};
    double overlaps[Hexadecad::lanes];
    for (int lane = 0; lane < Hexadecad::lanes; ++lane)
    {
        overlaps[lane] = r * std::pow(10, -1 - 0.4 * lane);  // 10 % down to 1e-7 of the radius
        Vector3<double> const between = (reach - overlaps[lane]) * along;
        double const square = between.dot(between);
        put(met.between, between, lane);
        met.square[lane] = static_cast<float>(square);
        met.closeness[lane] = static_cast<float>(reach * reach - square);
    }
    met.radius_a = met.radius_b = Hexadecad::Constant(r);
    met.velocity = met.spin_a = met.spin_b =
        Vector3<Hexadecad>{Hexadecad::Constant(0), Hexadecad::Constant(0), Hexadecad::Constant(0)};
    met.inverse_mass = met.inverse_inertia = Hexadecad::Constant(1);
    ContactGeometry<Hexadecad> const contact = meet<Plain, false>(met);
    double worst = 0, worst_of_lengths = 0;
    for (int lane = 0; lane < Hexadecad::lanes; ++lane)
    {
        worst = std::max(worst, std::abs(contact.overlap[lane] / overlaps[lane] - 1));
        float const length = std::sqrt(met.square[lane]);
        worst_of_lengths =
            std::max(worst_of_lengths, std::abs((static_cast<float>(reach) - length) / overlaps[lane] - 1));
    }
    figure("single_precision_overlap_error", worst);
    figure("single_precision_overlap_error_of_lengths", worst_of_lengths);
    // Four roundings of 6e-8; the difference of squares in double has 2e-16 (2 r / overlap) at most.
    EXPECT_LT(worst, 4e-7);
    // The obvious difference of two lengths loses all digits there: what the test is about.
    EXPECT_GT(worst_of_lengths, 0.1);
}

}  // namespace

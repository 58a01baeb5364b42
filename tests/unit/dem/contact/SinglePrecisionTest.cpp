// SPDX-License-Identifier: BSD-3-Clause
/// Laws in single precision, precision = "mixed": what they lose against double, and what they must not lose.
#include <gtest/gtest.h>

#include <cmath>

#include "Figure.hpp"
#include "LawScenes.hpp"
#include "contact/ContactModel.hpp"
#include "contact/Meeting.hpp"
#include "exec/Hexadecad.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;
using exec::Hexadecad;

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

TEST(SinglePrecision, SixteenLanesGiveWhatDoubleGives)
{
    double worst = 0;
    for (Case const& settings : all_laws())
    {
        SCOPED_TRACE(name_of_laws(settings));
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

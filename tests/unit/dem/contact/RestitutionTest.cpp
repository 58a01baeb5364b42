// SPDX-License-Identifier: BSD-3-Clause
#include "contact/Restitution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace
{

using namespace gimdem;

TEST(Restitution, OfAHertzContactThatNeverPullsIsThatOfAnIndependentIntegration)
{
    // What a contact that is damped for restitution `asked` gives when its attraction is cut off: a table made by
    // another program, to its six digits.
    struct
    {
        double asked, got;
    } const table[] = {{.1, .252728}, {.2, .324862}, {.3, .397140}, {.4, .472014}, {.5, .550283},
                       {.6, .632290}, {.7, .718201}, {.8, .808099}, {.9, .902026}};
    for (auto const& [asked, got] : table)
        EXPECT_NEAR(restitution_without_attraction(damping_ratio(asked), Stiffening::hertz), got, 2e-6) << asked;
}

TEST(Restitution, DampingForAHertzContactThatNeverPullsIsThatOfAnIndependentIntegration)
{
    // The same table read backwards: which restitution to set to get 0.2, 0.3 ...; five digits, which |beta| of a small
    // restitution multiplies by three.
    struct
    {
        double wanted, set;
    } const table[] = {{.2, .03447}, {.3, .16523}, {.4, .30390}, {.5, .43629},
                       {.6, .56118}, {.7, .67919}, {.8, .79117}, {.9, .89789}};
    for (auto const& [wanted, set] : table)
        EXPECT_NEAR(damping_ratio_without_attraction(wanted, Stiffening::hertz), damping_ratio(set), 3e-5) << wanted;
}

TEST(Restitution, OfALinearContactThatNeverPullsIsItsClosedForm)
{
    // x'' + 2 b x' + x = 0 until the force vanishes: e = exp(-b t), tan(w t) = -2 b w / (1 - 2 b^2), w^2 = 1 - b^2
    // [Schwager and Poeschel 2007].
    for (double const b : {0.01, 0.1, 0.3, 0.6, 0.8, 0.95})
    {
        double const w = std::sqrt(1 - b * b);
        double const t = std::atan2(2 * b * w, -(1 - 2 * b * b)) / w;
        // Steps of 4e-3 of a fourth-order rule: far below the tolerance; where the force ends, second order.
        EXPECT_NEAR(restitution_without_attraction(b, Stiffening::linear), std::exp(-b * t), 2e-6) << b;
    }
}

TEST(Restitution, DampingGivesBackWhatWasAsked)
{
    for (auto const stiffening : {Stiffening::linear, Stiffening::hertz})
        for (double const e : {0.05, 0.1, 0.35, 0.77, 0.99})
        {
            double const beta = damping_ratio_without_attraction(e, stiffening);
            EXPECT_NEAR(restitution_without_attraction(beta, stiffening), e, 1e-9);
            EXPECT_GT(beta, damping_ratio(e));  // what is not held back at the end must lose more before
        }
    EXPECT_EQ(damping_ratio_without_attraction(1, Stiffening::hertz), 0);
    EXPECT_NEAR(damping_ratio(0.5), std::log(2.0) / std::hypot(std::log(2.0), std::numbers::pi), 1e-15);
}

}  // namespace

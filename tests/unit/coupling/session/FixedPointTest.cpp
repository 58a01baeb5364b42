// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/FixedPoint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <barrier>
#include <cmath>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace gimdem::coupling
{
namespace
{

double constexpr epsilon = std::numeric_limits<double>::epsilon();

TEST(AitkenRelaxation, SolvesALinearProblemOfOneNumberInTwoPasses)
{
    // x = a x + b has the solution b / (1 - a), which plain iteration (factor 1) finds for |a| < 1 only.
    for (double const a : {-1000.0, -20.0, -1.5, -0.5, 0.3, 0.9, 3.0})
        for (double const first : {0.1, 0.5, 1.0})
        {
            double const b = 7, solution = b / (1 - a);
            AitkenRelaxation relaxation(first);
            std::vector<double> const start{2}, none;
            relaxation.start({start}, 1);
            double largest = std::abs(start[0]);
            for (int pass = 0; pass < 2; ++pass)
            {
                std::vector<double> const image{a * relaxation.guess(0)[0] + b};
                relaxation.take({image});
                relaxation.relax();
                largest = std::max(largest, std::abs(image[0]));
            }
            // Rounding of the largest number on the way, which the inverse of 1 - a makes larger; and of the factor,
            // which comes of differences.
            double const amplified = largest * std::max(1.0, 1 / std::abs(1 - a));
            EXPECT_NEAR(relaxation.guess(0)[0], solution, 1e2 * epsilon * amplified) << "a = " << a;
            EXPECT_NEAR(relaxation.factor(), 1 / (1 - a), 1e3 * epsilon * (1 + 1 / std::abs(1 - a))) << "a = " << a;
        }
}

TEST(AitkenRelaxation, DoesNotCareAboutUnits)
{
    // Two numbers with the same law; one is counted in units a million times as large.
    double const a = -30, unit = 1e6;
    AitkenRelaxation one(0.5), two(0.5);
    std::vector<double> const x{1}, y{1 * unit};
    one.start({x}, 1);
    two.start({x, y}, 2);
    for (int pass = 0; pass < 2; ++pass)
    {
        std::vector<double> const fx{a * one.guess(0)[0] + 4}, gx{a * two.guess(0)[0] + 4},
            gy{a * two.guess(1)[0] + 4 * unit};
        EXPECT_NEAR(one.take({fx}), two.take({gx, gy}), 4 * epsilon);
        one.relax();
        two.relax();
    }
    EXPECT_NEAR(two.guess(0)[0], 4 / (1 - a), 1e4 * epsilon);
    EXPECT_NEAR(two.guess(1)[0], 4 / (1 - a) * unit, 1e4 * epsilon * unit);
}

TEST(AitkenRelaxation, OfSeveralRanksIsThatOfTheWhole)
{
    // Two ranks in lockstep: what one adds up, the other does at the same place. Here the other's part is known, as it
    // is the same as this one's.
    auto const twice = [](Span<double> numbers)
    {
        for (double& number : numbers)
            number *= 2;
    };
    AitkenRelaxation whole(0.5), part(0.5, twice);
    std::vector<double> const start{1, 2, 1, 2}, half{1, 2};
    whole.start({start}, 1);
    part.start({half}, 1);
    for (int pass = 0; pass < 4; ++pass)
    {
        std::vector<double> images, image;
        for (std::size_t i = 0; i < 4; ++i)
            images.push_back(std::cos(static_cast<double>(3 + i % 2) * whole.guess(0)[i]));
        image.assign(images.begin(), images.begin() + 2);
        EXPECT_NEAR(whole.take({images}), part.take({image}), 1e-12);
        whole.relax();
        part.relax();
        EXPECT_NEAR(whole.guess(0)[1], part.guess(0)[1], 1e-12);
    }
}

/// Adds up over two threads, as MPI's all-reduce does over ranks.
class TwoRanks
{
public:
    void add_up(Span<double> numbers)
    {
        {
            std::lock_guard<std::mutex> const lock(mutex_);
            sums_.resize(numbers.size());
            for (std::size_t i = 0; i < numbers.size(); ++i)
                sums_[i] += numbers[i];
        }
        both_.arrive_and_wait();
        std::copy(told_.begin(), told_.end(), numbers.begin());
    }

private:
    /// Once both have added theirs.
    struct Tell
    {
        TwoRanks* ranks;
        void operator()() noexcept
        {
            ranks->told_.swap(ranks->sums_);
            ranks->sums_.clear();
        }
    };

    std::mutex mutex_;
    std::vector<double> sums_, told_;
    std::barrier<Tell> both_{2, Tell{this}};
};

/// Four passes over some numbers, of another law each.
std::vector<double> relaxed(AitkenRelaxation relaxation, std::vector<double> const& start, std::vector<double> const& a)
{
    relaxation.start({start}, 1);
    for (int pass = 0; pass < 4; ++pass)
    {
        std::vector<double> image(start.size());
        for (std::size_t i = 0; i < start.size(); ++i)
            image[i] = a[i] * relaxation.guess(0)[i] + 1;
        relaxation.take({image});
        relaxation.relax();
    }
    return {relaxation.guess(0).begin(), relaxation.guess(0).end()};
}

TEST(AitkenRelaxation, OfRanksWithUnlikePartsIsThatOfTheWhole)
{
    std::vector<double> const whole = relaxed(AitkenRelaxation(0.5), {1, 2, -3, 0.5}, {-2, 0.5, -7, 0.1});

    TwoRanks ranks;
    auto const sum = [&](Span<double> numbers) { ranks.add_up(numbers); };
    std::vector<double> first, second;
    std::thread other([&] { second = relaxed(AitkenRelaxation(0.5, sum), {-3, 0.5}, {-7, 0.1}); });
    first = relaxed(AitkenRelaxation(0.5, sum), {1, 2}, {-2, 0.5});
    other.join();

    first.insert(first.end(), second.begin(), second.end());
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(first[i], whole[i], 1e-12) << "sums in another order; the numbers stay below 100";
}

TEST(AitkenRelaxation, TakesBlocksAlongThatItDoesNotJudge)
{
    AitkenRelaxation relaxation(0.25);
    std::vector<double> const x{2}, noise{100};
    relaxation.start({x, noise}, 1);
    std::vector<double> const fx{4}, wild{-300};
    EXPECT_DOUBLE_EQ(relaxation.take({fx, wild}), 0.5);
    relaxation.relax();
    EXPECT_DOUBLE_EQ(relaxation.guess(0)[0], 2 + 0.25 * 2);
    EXPECT_DOUBLE_EQ(relaxation.guess(1)[0], 100 - 0.25 * 400);
}

TEST(AitkenRelaxation, HasNoResidualWhereNothingIs)
{
    AitkenRelaxation relaxation(0.5);
    std::vector<double> const zeros(5, 0.0), none;
    relaxation.start({zeros, none}, 2);
    EXPECT_EQ(relaxation.take({zeros, none}), 0);
    relaxation.relax();
    EXPECT_EQ(relaxation.take({zeros, none}), 0);
    relaxation.relax();
    EXPECT_EQ(relaxation.guess(0)[4], 0);
}

TEST(AitkenRelaxation, StartsEachProblemAnew)
{
    // A problem does not depend on those before it, so that a restart needs nothing of them.
    auto const solve = [](AitkenRelaxation& relaxation)
    {
        std::vector<double> const start{1};
        relaxation.start({start}, 1);
        for (int pass = 0; pass < 3; ++pass)
        {
            std::vector<double> const image{std::cos(3 * relaxation.guess(0)[0])};
            relaxation.take({image});
            relaxation.relax();
        }
        return relaxation.guess(0)[0];
    };
    AitkenRelaxation fresh(0.5), used(0.5);
    solve(used);
    EXPECT_EQ(solve(fresh), solve(used));
}

/// Fields of one cell.
struct OneCell
{
    std::array<double, 3> velocity{}, pressure_gradient{};

    FluidFields view() const
    {
        FluidFields fields;
        fields.velocity = velocity;
        fields.pressure_gradient = pressure_gradient;
        return fields;
    }
};

TEST(FluidFixedPoint, RepeatsUntilTheFieldsThatMoveParticlesStandStill)
{
    Iteration const settings{1e-6, 20, 0.5, false};
    FluidFixedPoint fixed_point(settings);
    OneCell fluid{{1, 0, 0}, {0, 0, 1000}};
    fixed_point.start(fluid.view());
    auto const image_of = [](FluidFields const& guess)
    {
        // Of slopes -5 and -2 in velocity and pressure gradient, which also depends on the velocity.
        OneCell image;
        image.velocity[0] = 3 - 5 * guess.velocity[0];
        image.pressure_gradient[2] = 600 - 2 * guess.pressure_gradient[2] + 100 * guess.velocity[0];
        return image;
    };
    FluidFields guess = fluid.view();
    OneCell image = image_of(guess);
    while (fixed_point.improve(image.view()))
        image = image_of(guess = fixed_point.guess());

    EXPECT_TRUE(fixed_point.converged());
    EXPECT_LE(fixed_point.residual(), settings.tolerance);
    EXPECT_GT(fixed_point.passes(), 2);
    // The error is the residual over 1 - slope, at most; the fields are of order 1 and 1000.
    EXPECT_NEAR(image.velocity[0], 0.5, 2e-6);
    EXPECT_NEAR(image.pressure_gradient[2], 650.0 / 3, 1e-3);
}

TEST(FluidFixedPoint, GivesUpAfterTheLastPass)
{
    FluidFixedPoint fixed_point({1e-12, 4, 0.5, false});
    OneCell fluid{{1, 0, 0}, {}};
    fixed_point.start(fluid.view());
    int passes = 1;
    while (fixed_point.improve(OneCell{{std::cos(40 * fixed_point.guess().velocity[0]), 1, 0}, {}}.view()))
        ++passes;
    EXPECT_EQ(passes, 4);
    EXPECT_FALSE(fixed_point.converged());
}

}  // namespace
}  // namespace gimdem::coupling

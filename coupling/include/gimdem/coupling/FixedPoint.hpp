// SPDX-License-Identifier: BSD-3-Clause
/// What a client of the schedule `iterated` needs beside Client: the fluid v that comes of the particles that move in
/// it, v = F(v), by relaxation with Aitken's factor, docs/theory.md (C.15)-(C.18).
///
///     FluidFixedPoint fixed_point(client.welcome().iteration);
///     client.begin_step(step, fluid_at_t);
///     fixed_point.start(fluid_at_t);
///     do
///     {
///         ... solve the fluid t -> t + dt from its state at t, with client.solid() ...
///     } while (fixed_point.improve(fluid_at_end) &&
///              (client.iterate_step(fixed_point.guess(), fixed_point.residual()), true));
///     client.end_step(timings, fixed_point.residual());
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <utility>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling
{

/// Aitken's relaxation of a vector that is made of blocks, each of a unit of its own: x <- x + w r, r = F(x) - x. The
/// factor w is exact after the second pass where F is linear in one number.
class AitkenRelaxation
{
public:
    using Blocks = std::vector<Span<double const>>;
    /// Adds each of some numbers up over the ranks that have a part of the blocks each, on all of them.
    using Sum = std::function<void(Span<double>)>;

    /// `first`: factor of the first pass of each problem, so that no problem depends on those before it. `sum`: empty
    /// for one process.
    explicit AitkenRelaxation(double first, Sum sum = {}) : first_(first), sum_(std::move(sum)) {}

    /// A new problem with its first guess. Only the first `judged` blocks decide about factor and residual.
    void start(Blocks const& guess, std::size_t judged)
    {
        judged_ = judged;
        factor_ = first_;
        passes_ = 0;
        guess_.resize(guess.size());
        for (std::size_t b = 0; b < guess.size(); ++b)
            guess_[b].assign(guess[b].begin(), guess[b].end());
        residual_.assign(guess.size(), {});
        weight_.assign(judged, 0);
    }

    /// What came of the guess. Returns the largest |F(x) - x| of a judged block over the larger of |F(x)| and |x|
    /// (C.18).
    double take(Blocks const& image)
    {
        before_.swap(residual_);
        residual_.resize(image.size());
        ++passes_;
        std::vector<double> squares;  // of residual, image and guess of each judged block
        for (std::size_t b = 0; b < image.size(); ++b)
        {
            residual_[b].resize(image[b].size());
            for (std::size_t i = 0; i < image[b].size(); ++i)
                residual_[b][i] = image[b][i] - guess_[b][i];
            if (b < judged_) squares.insert(squares.end(), {square(residual_[b]), square(image[b]), square(guess_[b])});
        }
        if (sum_) sum_(squares);
        double worst = 0;
        for (std::size_t b = 0; b < judged_; ++b)
        {
            double const scale = std::max(squares[3 * b + 1], squares[3 * b + 2]);
            if (passes_ == 1 && scale > 0) weight_[b] = 1 / scale;
            if (scale > 0) worst = std::max(worst, std::sqrt(squares[3 * b] / scale));
        }
        return worst;
    }

    /// The next guess, (C.16)-(C.17).
    void relax()
    {
        if (passes_ > 1) renew_factor();
        for (std::size_t b = 0; b < guess_.size(); ++b)
            for (std::size_t i = 0; i < guess_[b].size(); ++i)
                guess_[b][i] += factor_ * residual_[b][i];
    }

    Span<double const> guess(std::size_t block) const { return {guess_[block].data(), guess_[block].size()}; }
    double factor() const { return factor_; }
    int passes() const { return passes_; }  ///< so far

private:
    template <class Numbers>
    static double square(Numbers const& x)
    {
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            sum += x[i] * x[i];
        return sum;
    }

    void renew_factor()
    {
        std::vector<double> products(2);  // of the change of the residual with the one before, and with itself
        for (std::size_t b = 0; b < judged_; ++b)
            for (std::size_t i = 0; i < residual_[b].size(); ++i)
            {
                double const difference = residual_[b][i] - before_[b][i];
                products[0] += weight_[b] * before_[b][i] * difference;
                products[1] += weight_[b] * difference * difference;
            }
        if (sum_) sum_(products);
        double const ratio = products[1] > 0 ? -products[0] / products[1] : 1;
        if (std::isfinite(ratio)) factor_ *= ratio;
    }

    double first_, factor_ = 0;
    Sum sum_;
    int passes_ = 0;
    std::size_t judged_ = 0;
    std::vector<std::vector<double>> guess_, residual_, before_;
    std::vector<double> weight_;  ///< of each judged block: 1 / its square in the first pass
};

/// The same for the fields that a client sends. Velocity and pressure gradient are judged, as they move the particles;
/// the others are relaxed along.
class FluidFixedPoint
{
public:
    /// `sum`: for clients of several ranks, each with a part of the fields.
    explicit FluidFixedPoint(Iteration const& settings, AitkenRelaxation::Sum sum = {})
        : settings_(settings), relaxation_(settings.relaxation, std::move(sum))
    {
    }

    /// The fluid that begin_step() was given.
    void start(FluidFields const& sent) { relaxation_.start(blocks_of(sent), 2); }

    /// The fluid that came of it at the end of the step. True: repeat the step with guess().
    bool improve(FluidFields const& image)
    {
        residual_ = relaxation_.take(blocks_of(image));
        converged_ = residual_ <= settings_.tolerance;
        if (converged_ || passes() >= settings_.max_passes) return false;
        relaxation_.relax();
        return true;
    }

    FluidFields guess() const
    {
        FluidFields fields;
        std::size_t block = 0;
        for (auto* const field : {&fields.velocity, &fields.pressure_gradient, &fields.velocity_gradient,
                                  &fields.void_fraction_gradient, &fields.pressure})
            *field = relaxation_.guess(block++);
        return fields;
    }
    int passes() const { return relaxation_.passes(); }  ///< of this step
    double residual() const { return residual_; }        ///< of the last pass, relative
    bool converged() const { return converged_; }
    double factor() const { return relaxation_.factor(); }

private:
    static AitkenRelaxation::Blocks blocks_of(FluidFields const& f)
    {
        return {f.velocity, f.pressure_gradient, f.velocity_gradient, f.void_fraction_gradient, f.pressure};
    }

    Iteration settings_;
    AitkenRelaxation relaxation_;
    double residual_ = 0;
    bool converged_ = false;
};

}  // namespace gimdem::coupling

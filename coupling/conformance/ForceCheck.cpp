// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/ForceCheck.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gimdem::conformance
{
namespace
{

/// Room for a client that solves its equations to a tolerance, or in single precision; levels differ by a tenth.
double constexpr tolerance = 1e-5;
char const* const names[] = {"applied_force_x", "applied_force_y", "applied_force_z"};

}  // namespace

std::optional<ForceCheck::Force> ForceCheck::told_by(std::vector<coupling::Monitor> const& monitors)
{
    Force force{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        auto const found = std::find_if(monitors.begin(), monitors.end(),
                                        [&](auto const& monitor) { return monitor.name == names[axis]; });
        if (found == monitors.end()) return std::nullopt;
        force[axis] = found->value;
    }
    return force;
}

void ForceCheck::take(coupling::FluidState const& fluid)
{
    std::vector<double> const now(fluid.fields.velocity.begin(), fluid.fields.velocity.end());
    auto const told = told_by(fluid.monitors);
    if (told) silent_ = false;
    std::int64_t const step = fluid.step.number - 1;
    if (told && step > 0 && !now.empty()) compare(step, *told, now);
    velocities_.push_back(now);
    if (velocities_.size() > 2) velocities_.erase(velocities_.begin());
}

void ForceCheck::compare(std::int64_t step, Force const& told, std::vector<double> const& at_end)
{
    bool const serial = schedule_ != coupling::Schedule::overlapped;
    double const right = best_deviation(serial ? step : step - 1, step, at_end, told);
    double const other = best_deviation(serial ? step - 1 : step, step, at_end, told);
    ++compared_;
    if (right <= tolerance)
    {
        ++right_;
        worst_ = std::max(worst_, right);
        return;
    }
    if (other <= tolerance) ++other_level_;
    if (!first_wrong_.empty()) return;
    char text[200];
    Force const force = solid_.force(serial ? step : step - 1, at_end);
    std::snprintf(text, sizeof text, "in step %ld it applied (%.6g, %.6g, %.6g) N instead of (%.6g, %.6g, %.6g) N",
                  static_cast<long>(step), told[0], told[1], told[2], force[0], force[1], force[2]);
    first_wrong_ = text;
}

double ForceCheck::best_deviation(std::int64_t level, std::int64_t step, std::vector<double> const& at_end,
                                  Force const& told) const
{
    double best = deviation(level, at_end, told);
    for (auto const& velocity : velocities_)
        best = std::min(best, deviation(level, velocity, told));
    // The solid before the first step was computed with the fluid at rest.
    if (level == 0 || step == 0) best = std::min(best, deviation(level, std::vector<double>(at_end.size()), told));
    return best;
}

/// Largest component of told - S V, in units of the sum of the magnitudes.
double ForceCheck::deviation(std::int64_t level, std::vector<double> const& velocity, Force const& told) const
{
    Force const force = solid_.force(level, velocity);
    double const scale = solid_.magnitude(level, velocity);
    double worst = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        worst = std::max(worst, std::abs(told[axis] - force[axis]) / scale);
    return worst;
}

void ForceCheck::report(FindingsFile& findings) const
{
    if (silent_)
    {
        char const* const text =
            "not shown: report monitors applied_force_x, _y, _z, the sum of S V in the step before";
        findings.skip("conservation", text);
        findings.skip("time level", text);
        return;
    }
    bool const serial = schedule_ != coupling::Schedule::overlapped;
    int const known = right_ + other_level_;
    char text[120];
    std::snprintf(text, sizeof text, "%d of %d steps apply the force that was sent, to %.1e", known, compared_, worst_);
    findings.check("conservation", compared_ > 0 && known == compared_,
                   known == compared_ ? text : std::string(text) + "; " + first_wrong_);
    std::snprintf(text, sizeof text, "%d of %d steps use the particles at %s", right_, known, serial ? "t + dt" : "t");
    findings.check("time level", known > 0 && right_ == known, text);
}

}  // namespace gimdem::conformance

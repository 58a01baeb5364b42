// SPDX-License-Identifier: BSD-3-Clause
#include "session/StepOrder.hpp"

#include <algorithm>
#include <cmath>

#include "message/Message.hpp"

namespace gimdem::coupling::session
{
namespace
{

/// Relative to the time itself: room for a client that adds up its steps, none for one that skips a part of one.
double constexpr time_tolerance = 1e-9;

std::optional<std::string> find_fault_of_length(Step const& step)
{
    if (std::isfinite(step.dt) && step.dt > 0) return std::nullopt;
    return "step " + std::to_string(step.number) + " has dt = " + message::number_text(step.dt) +
           " s (it must be positive)";
}

}  // namespace

std::optional<std::string> StepOrder::find_fault_of_repeat(Step const& again, int pass) const
{
    std::string const who = "pass " + std::to_string(pass) + " of step " + std::to_string(again.number);
    if (last_.number == 0 || again.number != last_.number || pass != pass_ + 1)
        return who + " follows pass " + std::to_string(pass_) + " of step " + std::to_string(last_.number) +
               " (only the last step can be repeated, and passes are numbered 0, 1, 2, ...)";
    if (!(again.time == last_.time))
        return who + " begins at " + message::number_text(again.time) + " s (the pass before it did at " +
               message::number_text(last_.time) + " s)";
    return find_fault_of_length(again);
}

std::optional<std::string> StepOrder::find_fault(Step const& next) const
{
    std::string const who = "step " + std::to_string(next.number);
    if (next.number != last_.number + 1)
        return who + " follows step " + std::to_string(last_.number) + " (steps are numbered 1, 2, 3, ...)";
    if (!std::isfinite(next.time))
        return who + " begins at " + message::number_text(next.time) + " s (it must be finite)";
    if (auto fault = find_fault_of_length(next)) return fault;
    if (last_.number == 0) return std::nullopt;

    double const expected = last_.time + last_.dt;
    double const tolerance = time_tolerance * std::max(std::abs(expected), last_.dt);
    if (std::abs(next.time - expected) <= tolerance) return std::nullopt;
    return who + " begins at " + message::number_text(next.time) + " s (the step before it ended at " +
           message::number_text(expected) + " s)";
}

}  // namespace gimdem::coupling::session

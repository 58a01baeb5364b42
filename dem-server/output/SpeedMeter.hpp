// SPDX-License-Identifier: BSD-3-Clause
/// How fast a run goes, lately. No clock of its own: times go in.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>

namespace gimdem::output
{

/// Means over the last half minute, or since the first step.
class SpeedMeter
{
public:
    /// A step ended at this wall time, at this simulated time [s].
    void add(double wall, double simulated)
    {
        last_ = {wall, simulated, last_.steps + 1};
        if (kept_.empty() || wall - kept_.back().wall >= window / most_kept) kept_.push_back(last_);
        while (kept_.size() > 2 && wall - kept_[1].wall >= window)
            kept_.pop_front();
    }

    double steps_per_second() const { return ratio(static_cast<double>(last_.steps - first().steps), wall()); }
    double wall_per_simulated() const { return ratio(wall(), last_.simulated - first().simulated); }

private:
    struct Mark
    {
        double wall = 0, simulated = 0;  ///< [s]
        std::int64_t steps = 0;
    };

    static constexpr double window = 30;  ///< [s]
    static constexpr double most_kept = 60;

    Mark const& first() const { return kept_.empty() ? last_ : kept_.front(); }
    double wall() const { return last_.wall - first().wall; }
    static double ratio(double part, double whole)
    {
        return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
    }

    std::deque<Mark> kept_;  ///< oldest first
    Mark last_;
};

}  // namespace gimdem::output

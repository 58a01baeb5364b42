// SPDX-License-Identifier: BSD-3-Clause
/// How much of their wall time two solvers spend side by side, theory.md (C.8)-(C.10).
#pragma once

#include <algorithm>

namespace gimdem::output
{

/// Wall times of one coupling step [s].
struct StepTimes
{
    double dem = 0;   ///< the particle side at work
    double cfd = 0;   ///< the fluid side at work
    double wall = 0;  ///< the step from its beginning to that of the next
};

/// What both would have taken one after the other, less what they took, (C.8) [s]. Below 0 where the exchange took
/// longer than what was gained.
inline double saved(StepTimes const& t)
{
    return t.dem + t.cfd - t.wall;
}

/// The most that working side by side can save: the shorter of the two, (C.8) [s].
inline double savable(StepTimes const& t)
{
    return std::min(t.dem, t.cfd);
}

/// (C.9) of one step, 0 where nothing could be saved.
inline double overlap_efficiency(StepTimes const& t)
{
    return savable(t) > 0 ? saved(t) / savable(t) : 0;
}

/// The same of many steps.
class OverlapMeter
{
public:
    void add(StepTimes const& t)
    {
        saved_ += saved(t);
        savable_ += savable(t);
        wall_ += t.wall;
        longer_ += std::max(t.dem, t.cfd);
    }

    /// (C.9): 1 where the shorter of the two always hides behind the longer, 0 where one always waits for the other.
    double efficiency() const { return savable_ > 0 ? saved_ / savable_ : 0; }
    /// (C.10): wall time over that of the slower solver alone; 1 is the least.
    double wall_over_longer() const { return longer_ > 0 ? wall_ / longer_ : 0; }

private:
    double saved_ = 0, savable_ = 0, wall_ = 0, longer_ = 0;  ///< [s]
};

}  // namespace gimdem::output

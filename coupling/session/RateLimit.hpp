// SPDX-License-Identifier: BSD-3-Clause
/// How often something may be done at most. No clock of its own: times go in.
#pragma once

#include <algorithm>

#include "transport/Clock.hpp"

namespace gimdem::coupling::session
{

/// `rate` times a second on average, and as many at once after a pause of a second.
class RateLimit
{
public:
    explicit RateLimit(double rate) : rate_(rate), saved_(rate) {}

    /// Whether it may be done now; if so, it counts as done.
    bool allows(transport::Time now)
    {
        saved_ = std::min(rate_, saved_ + rate_ * transport::seconds_between(last_, now));
        last_ = now;
        if (saved_ < 1) return false;
        saved_ -= 1;
        return true;
    }

private:
    double rate_;   ///< [1/s]
    double saved_;  ///< may be done at once
    transport::Time last_{};
};

}  // namespace gimdem::coupling::session

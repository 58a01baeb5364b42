// SPDX-License-Identifier: BSD-3-Clause
/// The client's clock beside the server's, from messages there and back. No clock of its own: times go in.
#pragma once

#include <algorithm>
#include <optional>

#include "gimdem/coupling/StepTimes.hpp"

namespace gimdem::coupling::session
{

/// As NTP does it (RFC 5905, section 8): a message left the client at t0 and reached the server at t1, the answer left
/// the server at t2 and reached the client at t3. Whatever the two ways took, the offset, client minus server, lies in
/// [t0 - t1, t3 - t2]: its middle is the estimate, half its width the uncertainty. docs/protocol.md, Clocks.
class OffsetEstimate
{
public:
    void add(double t0, double t1, double t2, double t3)
    {
        double const uncertainty = 0.5 * ((t3 - t0) - (t2 - t1));
        if (!(uncertainty >= 0) || !(t1 > 0)) return;  // not the times of a message there and back
        auto const kept = at(t3);
        if (kept && kept->uncertainty <= uncertainty) return;
        best_ = ClockOffset{0.5 * ((t0 - t1) + (t3 - t2)), uncertainty};
        taken_at_ = t3;
    }

    /// Both run on one machine, so they read one clock, unless what was measured proves otherwise.
    void expect_one_clock() { one_machine_ = true; }

    /// Now, by the client's clock. Empty before the first exchange.
    std::optional<ClockOffset> at(double now) const
    {
        if (!best_) return std::nullopt;
        double const uncertainty = best_->uncertainty + drift * std::max(0.0, now - taken_at_);
        if (one_machine_ && std::max(best_->offset, -best_->offset) <= uncertainty) return ClockOffset{0, 0};
        return ClockOffset{best_->offset, uncertainty};
    }

private:
    /// Two clocks part by so much per second at most: PHI of RFC 5905.
    static constexpr double drift = 15e-6;

    std::optional<ClockOffset> best_;
    double taken_at_ = 0;  ///< by the client's clock [s]
    bool one_machine_ = false;
};

}  // namespace gimdem::coupling::session

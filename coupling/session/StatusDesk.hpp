// SPDX-License-Identifier: BSD-3-Clause
/// What a server says to those who ask how the run stands.
#pragma once

#include <mutex>
#include <string>

#include "gimdem/coupling/Status.hpp"
#include "session/RateLimit.hpp"

namespace gimdem::coupling::session
{

class StatusDesk
{
public:
    /// The program's thread: what is true from now on.
    void publish(RunStatus run);
    void publish(ClockOffset const& clock);

    /// I/O thread: whether a question may be answered now.
    bool may_answer(transport::Time now) { return limit_.allows(now); }
    /// Any thread: what the program has published, and what the system tells of this process.
    Status fill() const;

private:
    /// An answer reads one small file and writes one short message: so many cost the I/O thread next to nothing.
    static constexpr double answers_per_second = 20;

    RateLimit limit_{answers_per_second};
    transport::Time const opened_ = transport::Clock::now();
    mutable std::mutex mutex_;  ///< guards what follows
    RunStatus run_;
    ClockOffset clock_{0, not_known};
};

}  // namespace gimdem::coupling::session

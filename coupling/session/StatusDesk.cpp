// SPDX-License-Identifier: BSD-3-Clause
#include "session/StatusDesk.hpp"

#include <unistd.h>

#include <fstream>
#include <utility>

namespace gimdem::coupling::session
{
namespace
{

/// Resident memory of this process [B].
double resident_memory()
{
    std::ifstream file("/proc/self/statm");
    double size = 0;
    double resident = not_known;
    file >> size >> resident;
    return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

void StatusDesk::publish(RunStatus run)
{
    std::lock_guard<std::mutex> const lock(mutex_);
    std::swap(run_, run);
}

void StatusDesk::publish(ClockOffset const& clock)
{
    std::lock_guard<std::mutex> const lock(mutex_);
    clock_ = clock;
}

Status StatusDesk::fill() const
{
    Status status;
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        status.run = run_;
        status.clock = clock_;
    }
    status.uptime = transport::seconds_between(opened_, transport::Clock::now());
    status.memory = resident_memory();
    status.process = ::getpid();
    return status;
}

}  // namespace gimdem::coupling::session

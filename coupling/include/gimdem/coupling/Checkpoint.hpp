// SPDX-License-Identifier: BSD-3-Clause
/// Checkpoints of a pair: one state of both sides, from which both go on.
#pragma once

#include <cstdint>
#include <string>

namespace gimdem::coupling
{

/// Where a client goes on that stopped before.
struct ResumePoint
{
    std::uint64_t session = 0;  ///< that saved the checkpoint
    std::int64_t step = 0;      ///< SavedCheckpoint::step
    double time = 0;            ///< of the fluid [s]

    friend bool operator==(ResumePoint const& a, ResumePoint const& b)
    {
        return a.session == b.session && a.step == b.step && a.time == b.time;
    }
};

/// What a client asks its server for between two steps.
struct CheckpointRequest
{
    double time = 0;                 ///< where the last step ended [s]
    std::int64_t complete_step = 0;  ///< SavedCheckpoint::step of the newest one to which the client has a fluid
};

/// What the server has saved.
struct SavedCheckpoint
{
    std::uint64_t session = 0;  ///< in which it was saved; the library sets it
    std::int64_t step = 0;      ///< the server's count of steps, which goes on over restarts
    double time = 0;            ///< of the particles [s]
    std::string name;           ///< of the file, without its folder
};

}  // namespace gimdem::coupling

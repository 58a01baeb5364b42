// SPDX-License-Identifier: BSD-3-Clause
/// Checkpoint, CheckpointSaved, and the place in Hello where a client goes on.
#pragma once

#include <optional>

#include "gimdem/coupling/Checkpoint.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

/// Fault::user if a number or the name cannot be sent.
Message pack(CheckpointRequest const& request);
Message pack(SavedCheckpoint const& saved);
void pack_resume_point(ResumePoint const& point, v1::Hello& hello);

/// Fault::protocol if a number in it cannot be true.
CheckpointRequest unpack_checkpoint_request(Message const& message);
SavedCheckpoint unpack_saved_checkpoint(Message const& message);
std::optional<ResumePoint> unpack_resume_point(v1::Hello const& hello);

}  // namespace gimdem::coupling::message

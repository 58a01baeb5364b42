// SPDX-License-Identifier: BSD-3-Clause
#include "message/CheckpointMessages.hpp"

#include <cmath>
#include <limits>

namespace gimdem::coupling::message
{
namespace
{

void require_sendable(double time, std::int64_t step)
{
    if (std::isfinite(time) && step >= 0) return;
    throw CouplingError(Fault::user, "a checkpoint at time " + number_text(time) + " s, step " + std::to_string(step) +
                                         " (the time must be finite, the step 0 or more); check the call");
}

void check_received(double time, std::int64_t step, char const* whose)
{
    check_number(time, std::numeric_limits<double>::lowest(), whose);
    if (step < 0) refuse(std::string(whose) + ": step " + std::to_string(step) + " (0 or more)");
}

}  // namespace

Message pack(CheckpointRequest const& request)
{
    require_sendable(request.time, request.complete_step);
    Message message;
    v1::Checkpoint& body = *message.envelope.mutable_checkpoint();
    body.set_time(request.time);
    body.set_complete_step(request.complete_step);
    return message;
}

Message pack(SavedCheckpoint const& saved)
{
    require_sendable(saved.time, saved.step);
    Message message;
    v1::CheckpointSaved& body = *message.envelope.mutable_checkpoint_saved();
    body.set_step(saved.step);
    body.set_time(saved.time);
    body.set_name(printable(saved.name));
    return message;
}

void pack_resume_point(ResumePoint const& point, v1::Hello& hello)
{
    require_sendable(point.time, point.step);
    v1::ResumePoint& body = *hello.mutable_resume();
    body.set_session(point.session);
    body.set_step(point.step);
    body.set_time(point.time);
}

CheckpointRequest unpack_checkpoint_request(Message const& message)
{
    v1::Checkpoint const& body = message.envelope.checkpoint();
    check_received(body.time(), body.complete_step(), "Checkpoint");
    return {body.time(), body.complete_step()};
}

SavedCheckpoint unpack_saved_checkpoint(Message const& message)
{
    v1::CheckpointSaved const& body = message.envelope.checkpoint_saved();
    check_received(body.time(), body.step(), "CheckpointSaved");
    check_name(body.name(), "CheckpointSaved: the name of the file");
    return {message.envelope.session(), body.step(), body.time(), body.name()};
}

std::optional<ResumePoint> unpack_resume_point(v1::Hello const& hello)
{
    if (!hello.has_resume()) return std::nullopt;
    v1::ResumePoint const& body = hello.resume();
    check_received(body.time(), body.step(), "Hello: the place to go on");
    return ResumePoint{body.session(), body.step(), body.time()};
}

}  // namespace gimdem::coupling::message

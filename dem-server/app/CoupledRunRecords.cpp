// SPDX-License-Identifier: BSD-3-Clause
/// What a coupled run leaves behind: checkpoints, figures and the last state of the particles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/CoupledRun.hpp"
#include "core/Error.hpp"

namespace gimdem::app
{

coupling::SavedCheckpoint CoupledRun::save(coupling::CheckpointRequest const& request)
{
    is_asked_ = true;
    accept();
    complete_step_ = std::max(complete_step_, std::min(request.complete_step, at_.step));
    if (at_.step == 0) at_.time = request.time;
    if (std::abs(request.time - at_.time) > 1e-9 * std::abs(at_.time))
        throw UserError(
            fmt::format("the client asks for a checkpoint at {:.9g} s, the particles are at {:.9g} s (they must be of "
                        "one time); ask between two steps, with the time where the last one ended",
                        request.time, at_.time));
    keep();
    return {.step = at_.step, .time = at_.time, .name = checkpoint_file(folder_, at_).filename().string()};
}

void CoupledRun::finish()
{
    accept();
    finish_records();
    keep();
}

void CoupledRun::finish_after_failure() noexcept
{
    auto const attempt = [this](auto const& write)
    {
        try
        {
            write();
        }
        catch (std::exception const& error)
        {
            events_.warn("not_written", error.what());
        }
    };
    attempt([&] { accept(); });
    attempt([&] { finish_records(); });
    if (!is_in_step_) attempt([&] { keep(); });
}

void CoupledRun::finish_records()
{
    coupling_log_.add_to(log_.summary());
    observer_.finish(log_.summary());
    log_.finish(bytes_before_ + server_.bytes());
}

bool CoupledRun::is_checkpoint_between(double before, double now) const
{
    double const interval = settings_.output.checkpoint_interval;
    auto const count = [=](double time) { return std::floor(time / interval + 1e-6); };
    return interval > 0 && count(now) > count(before);
}

void CoupledRun::keep()
{
    if (kept_ == at_.step) return;
    MappedState const mapped = engine_.mapped();
    write_checkpoint(checkpoint_file(folder_, at_), settings_, at_, inlets_, system_, engine_.weight_reuse(), &mapped);
    kept_ = at_.step;
    log_.remember(at_.time);
    if (is_asked_)
        keep_newest_checkpoints(folder_, complete_step_);
    else
        keep_newest_checkpoints(folder_);
    events_.note("checkpoint", "the particles are saved", {{"time_s", at_.time}});
}

}  // namespace gimdem::app

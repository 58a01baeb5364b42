// SPDX-License-Identifier: BSD-3-Clause
/// The client's end of a session: what Client does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gimdem/coupling/Client.hpp"
#include "message/CheckpointMessages.hpp"
#include "message/StepMessages.hpp"
#include "session/ClientRecord.hpp"
#include "session/ExchangeClock.hpp"
#include "session/Session.hpp"
#include "session/SharedFields.hpp"

namespace gimdem::coupling::session
{

class ClientSession
{
public:
    explicit ClientSession(ClientOptions given);

    void connect(FluidProperties const& properties);
    void send_mesh(MeshView const& mesh);
    void begin_step(Step const& next, FluidFields const& fields, std::vector<Monitor> const& monitors);
    void iterate_step(FluidFields const& estimate, double residual);
    void end_step(Timings const& timings, double residual);
    SavedCheckpoint save_checkpoint(CheckpointRequest const& request);
    void finish(std::string const& reason);
    void abort(std::string const& reason) noexcept;

    /// After each call: what it moved, or what was wrong if it threw and the session may go on.
    void count_bytes() { clock_.set_bytes(session_.bytes()); }
    void note_fault(std::string const& text);

    message::SolidState const& solid() const { return solid_; }
    Welcome const& welcome() const { return welcome_; }
    ExchangeTimes const& exchange_times() const { return clock_.times(); }
    std::string const& shared_memory_note() const { return shared_.note(); }

private:
    void check_rank_endpoints();
    void log_connection();
    Event begin_event() const;
    void send_fluid(Event call, FluidState const& given, Time entered);
    void send_whole_fluid();
    Letter receive(std::string const& awaited);
    Time take_solid();
    bool overlaps() const { return welcome_.schedule == Schedule::overlapped; }

    ClientOptions options_;
    std::optional<transport::ClientKeys> keys_;
    Welcome welcome_;
    message::Terms terms_;
    SharedFields shared_;             ///< outlives the messages that lie in it
    message::Message solid_message_;  ///< holds the bytes that the spans of solid_ show
    message::SolidState solid_;
    FluidState fluid_;              ///< that was sent last, while its spans live: the server may want all of it
    Timings previous_;              ///< of the last fluid step
    double previous_residual_ = 0;  ///< of the last pass of the step before
    Step step_;
    int pass_ = 0;  ///< of this step
    ExchangeClock clock_;
    ClientRecord record_;
    Time fluid_leaves_;  ///< that of this step does not before: the clocks' offset is bounded by it
    Session session_;
};

}  // namespace gimdem::coupling::session

// SPDX-License-Identifier: BSD-3-Clause
/// The server's end of one session: a client of one process, or one rank of several.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "message/CheckpointMessages.hpp"
#include "message/Greeting.hpp"
#include "message/StepMessages.hpp"
#include "session/Exchange.hpp"
#include "session/Session.hpp"
#include "session/SharedFields.hpp"
#include "session/StepOrder.hpp"

namespace gimdem::coupling::session
{

/// A client that has come, and is to be answered.
struct Newcomer
{
    Letter letter;
    message::Hello hello;
};

class ServerSession : public Exchange
{
public:
    /// expected: which rank must come; empty for rank 0, which tells how many there are.
    explicit ServerSession(ServerOptions given, std::optional<Rank> expected = std::nullopt);

    /// The two halves of wait_for_client(): Hello and Welcome. rank_endpoints: where the other ranks are met.
    Newcomer await_hello(ServerTerms const& offered);
    ClientInfo welcome(Newcomer const& newcomer, ServerTerms const& offered,
                       std::vector<std::string> const& rank_endpoints);

    std::string const& endpoint() const override { return session_.endpoint(); }
    ClientInfo wait_for_client(ServerTerms const& offered) override
    {
        return welcome(await_hello(offered), offered, {});
    }
    Mesh receive_mesh() override;
    void accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells) override;
    std::optional<FluidState> receive_fluid() override;
    void ask_for_whole(FluidState const& fluid) override;
    void take_whole(FluidState& fluid) override;
    void send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells) override;
    void wake_client() override;
    void request_stop(std::string const& reason) override;
    void abort(Fault fault, std::string const& reason) noexcept override { session_.abort(fault, reason); }
    std::string const& goodbye_reason() const override { return goodbye_; }
    std::string const& shared_memory_note() const override { return shared_.note(); }
    double bytes() const override { return session_.bytes(); }
    void set_watch(std::function<void()> watch) override { session_.set_watch(std::move(watch)); }
    void look_for_loss() override { session_.look_for_loss("all ranks"); }
    bool has_failed() const override { return session_.state() == State::failed; }
    bool has_lost_client() const override { return session_.has_lost_peer(); }

    void save_checkpoints_by(Server::CheckpointSaver saver) { saver_ = std::move(saver); }
    ServerOptions const& options() const { return options_; }
    ServerTimes const& step_times() const { return times_; }
    std::optional<LastClientStep> const& last_client_step() const { return last_client_step_; }
    Session& session() { return session_; }
    Session const& session() const { return session_; }

private:
    void wait_for_contact();
    void check_rank(Rank const& rank);
    Schedule choose_schedule(message::Hello const& hello, ServerTerms const& offered);
    /// Of several ranks, rank 0 asks for all.
    bool saves_checkpoints() const { return saver_ && !expected_rank_; }

    Letter receive(std::string const& awaited);
    void save_checkpoint(Letter const& letter);
    bool said_goodbye(Letter const& letter);
    void check_order(FluidState const& fluid);
    std::optional<std::string> stop_reason();

    ServerOptions options_;
    message::Terms terms_;
    Server::CheckpointSaver saver_;
    SharedFields shared_;             ///< outlives the messages that lie in it
    message::Message fluid_message_;  ///< holds the bytes that the spans of the last FluidState show
    StepOrder order_;
    bool iterates_ = false;  ///< the schedule iterated is in force
    int pass_ = 0;           ///< of the fluid that is being answered
    std::string goodbye_;
    double busy_before_ = 0;  ///< the last fluid lay here unread for so long [s]
    Time handed_out_;         ///< when receive_fluid() returned
    double waking_ = 0;       ///< what it took since then to wake the client up [s]
    ServerTimes times_;       ///< of the last step
    std::optional<LastClientStep> last_client_step_;
    std::mutex stop_mutex_;  ///< request_stop() may come from another thread
    std::optional<std::string> stop_;
    std::optional<Rank> expected_rank_;
    Session session_;
};

}  // namespace gimdem::coupling::session

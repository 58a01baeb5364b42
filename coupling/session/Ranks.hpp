// SPDX-License-Identifier: BSD-3-Clause
/// The ranks of one client, treated as one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "message/Fields.hpp"
#include "session/Exchange.hpp"
#include "session/RankCells.hpp"

namespace gimdem::coupling::session
{

/// "rank 1", for texts.
std::string rank_text(std::size_t rank);

/// Where the server listens for a rank, from 1 on: beside the socket file of rank 0, or at any free port.
std::string endpoint_of_rank(std::string const& endpoint, std::int32_t rank);

/// Every rank has a session of its own, with its own socket, heartbeats and shared memory. Here their meshes are
/// merged, their fields put one after the other, and their steps compared; what ends one of them ends all.
class Ranks final : public Exchange
{
public:
    using Parts = std::vector<std::unique_ptr<Exchange>>;

    /// first: rank 0, whose Hello has told of the others; it stays the caller's. others: bound and listening.
    Ranks(Exchange& first, Parts others);

    /// Of ranks 1, 2, ...: what Welcome tells rank 0.
    std::vector<std::string> endpoints() const;
    /// After rank 0 was welcomed. Fault::protocol if another rank tells of another fluid than rank 0.
    void wait_for_others(ClientInfo const& first, ServerTerms const& terms);

    std::string const& endpoint() const override { return parts_.front()->endpoint(); }
    ClientInfo wait_for_client(ServerTerms const& terms) override { return parts_.front()->wait_for_client(terms); }
    Mesh receive_mesh() override;
    void accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells) override;
    std::optional<FluidState> receive_fluid() override;
    void ask_for_whole(FluidState const& fluid) override;
    void take_whole(FluidState& fluid) override;
    void send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells) override;
    void wake_client() override;
    void request_stop(std::string const& reason) override;
    void abort(Fault fault, std::string const& reason) noexcept override;

    std::string const& goodbye_reason() const override { return parts_.front()->goodbye_reason(); }
    std::string const& shared_memory_note() const override;
    double bytes() const override;
    void set_watch(std::function<void()> watch) override;
    void look_for_loss() override;
    bool has_failed() const override;
    bool has_lost_client() const override { return has_lost_client_; }

private:
    /// Runs a call; if one rank's session ends in it, so do the others, with the same reason.
    template <class Body>
    auto together(Body body) -> decltype(body());
    void end_all(std::string const& reason) noexcept;
    [[noreturn]] void fail(Fault fault, std::string const& text);
    std::vector<FluidState> receive_fluids();
    void check_same_step(std::vector<FluidState> const& states);
    void forward_stop();

    std::vector<Exchange*> parts_;  ///< by rank
    Parts others_;
    std::string name_;  ///< of the client
    message::FieldChoice<SolidFields> wants_;
    RankCells cells_;                 ///< holds what the spans of the last FluidState show
    std::vector<FluidState> fluids_;  ///< by rank, of the last step
    bool has_lost_client_ = false;    ///< the rank whose session ended first was lost
    std::mutex stop_mutex_;           ///< request_stop() may come from another thread
    std::optional<std::string> stop_;
};

template <class Body>
auto Ranks::together(Body body) -> decltype(body())
{
    try
    {
        return body();
    }
    catch (CouplingError const& error)
    {
        end_all(error.what());
        throw;
    }
}

}  // namespace gimdem::coupling::session

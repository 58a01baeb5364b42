// SPDX-License-Identifier: BSD-3-Clause
/// What the server's program does with its client, be that one process or several.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "gimdem/coupling/Server.hpp"

namespace gimdem::coupling::session
{

/// The calls of Server, and what is needed to treat several ranks as one.
class Exchange
{
public:
    virtual ~Exchange() = default;

    virtual std::string const& endpoint() const = 0;
    virtual ClientInfo wait_for_client(ServerTerms const& terms) = 0;
    virtual Mesh receive_mesh() = 0;
    virtual void accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells) = 0;
    virtual std::optional<FluidState> receive_fluid() = 0;
    /// complete() in two halves, so that all ranks can be asked before one is waited for.
    virtual void ask_for_whole(FluidState const& fluid) = 0;
    virtual void take_whole(FluidState& fluid) = 0;
    virtual void send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells) = 0;
    virtual void wake_client() = 0;
    virtual void request_stop(std::string const& reason) = 0;

    /// Tells the client why, and ends the session.
    virtual void abort(Fault fault, std::string const& reason) noexcept = 0;

    virtual std::string const& goodbye_reason() const = 0;
    virtual std::string const& shared_memory_note() const = 0;
    virtual double bytes() const = 0;

    /// While a call waits, `watch` is called again and again; what it throws ends the call.
    virtual void set_watch(std::function<void()> watch) = 0;
    /// Throws what the next call would throw because the client is gone or out of order.
    virtual void look_for_loss() = 0;
    /// A fault has ended it.
    virtual bool has_failed() const = 0;
    /// Because the client is gone, silent or slow; it has not said why.
    virtual bool has_lost_client() const = 0;
};

}  // namespace gimdem::coupling::session

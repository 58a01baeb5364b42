// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/Server.hpp"

#include <algorithm>
#include <utility>

#include "session/Ranks.hpp"
#include "session/ServerSession.hpp"

namespace gimdem::coupling
{

using session::Event;
using session::ServerSession;

bool ClientInfo::wants_field(std::string const& field_name) const
{
    return std::find(wants.begin(), wants.end(), field_name) != wants.end();
}

struct Server::Impl
{
    explicit Impl(ServerOptions options) : first(std::move(options)) {}

    ClientInfo wait_for_client(ServerTerms const& terms);
    void listen_for_others(Rank const& rank);
    /// The whole client: one process, or all ranks.
    session::Exchange& whole()
    {
        if (ranks) return *ranks;
        return first;
    }

    /// Runs a call; a fault that leaves the session alive is remembered, in case the program ends because of it.
    template <class Body>
    auto guard(Body body) -> decltype(body())
    {
        try
        {
            return body();
        }
        catch (CouplingError const& error)
        {
            first.session().note(error.what());
            throw;
        }
    }

    ServerSession first;                    ///< with the client's only process, or with rank 0
    std::unique_ptr<session::Ranks> ranks;  ///< null: the client is one process
};

ClientInfo Server::Impl::wait_for_client(ServerTerms const& terms)
{
    session::Newcomer const newcomer = first.await_hello(terms);
    if (newcomer.hello.rank.count > 1) listen_for_others(newcomer.hello.rank);
    ClientInfo const info = first.welcome(newcomer, terms, ranks ? ranks->endpoints() : std::vector<std::string>());
    if (ranks) ranks->wait_for_others(info, terms);
    return info;
}

/// Binds an endpoint for each rank but 0.
void Server::Impl::listen_for_others(Rank const& rank)
{
    session::Ranks::Parts others;
    for (std::int32_t number = 1; number < rank.count; ++number)
    {
        ServerOptions own = first.options();
        own.endpoint = session::endpoint_of_rank(first.endpoint(), number);
        others.push_back(std::make_unique<ServerSession>(own, Rank{number, rank.count, rank.run}));
    }
    ranks = std::make_unique<session::Ranks>(first, std::move(others));
}

Server::Server(ServerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Server::~Server() = default;
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;

std::string const& Server::endpoint() const
{
    return impl_->first.endpoint();
}

void Server::save_checkpoints_by(CheckpointSaver saver)
{
    impl_->first.save_checkpoints_by(std::move(saver));
}

ClientInfo Server::wait_for_client(ServerTerms const& terms)
{
    return impl_->guard([&] { return impl_->wait_for_client(terms); });
}

Mesh Server::receive_mesh()
{
    return impl_->guard([&] { return impl_->whole().receive_mesh(); });
}

void Server::accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells)
{
    impl_->guard([&] { impl_->whole().accept_mesh(initial, timings, cells); });
}

void Server::reject_mesh(std::string const& why)
{
    impl_->guard(
        [&]
        {
            impl_->first.session().require(Event::reject_mesh);
            impl_->whole().abort(Fault::mesh, why);
        });
}

std::optional<FluidState> Server::receive_fluid()
{
    return impl_->guard([&] { return impl_->whole().receive_fluid(); });
}

std::string const& Server::goodbye_reason() const
{
    return impl_->whole().goodbye_reason();
}

void Server::complete(FluidState& fluid)
{
    impl_->guard(
        [&]
        {
            impl_->whole().ask_for_whole(fluid);
            impl_->whole().take_whole(fluid);
        });
}

void Server::wake_client()
{
    impl_->whole().wake_client();
}

void Server::send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells)
{
    impl_->guard([&] { impl_->whole().send_solid(fields, timings, cells); });
}

bool Server::has_lost_client() const
{
    return impl_->whole().has_lost_client();
}

std::uint64_t Server::session_number() const
{
    return impl_->first.session().session_number();
}

void Server::abort(std::string const& reason) noexcept
{
    impl_->whole().abort(Fault::user, reason);
}

void Server::request_stop(std::string const& reason)
{
    impl_->whole().request_stop(reason);
}

ServerTimes const& Server::step_times() const
{
    return impl_->first.step_times();
}

std::optional<LastClientStep> const& Server::last_client_step() const
{
    return impl_->first.last_client_step();
}

void Server::publish(RunStatus run)
{
    impl_->first.session().status_desk().publish(std::move(run));
}

double Server::bytes() const
{
    return impl_->whole().bytes();
}

std::string const& Server::shared_memory_note() const
{
    return impl_->whole().shared_memory_note();
}

}  // namespace gimdem::coupling

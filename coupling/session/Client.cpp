// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/Client.hpp"

#include <algorithm>
#include <utility>

#include "session/ClientSession.hpp"

namespace gimdem::coupling
{

bool Welcome::needs_field(std::string const& name) const
{
    return std::find(needs.begin(), needs.end(), name) != needs.end();
}

struct Client::Impl
{
    explicit Impl(ClientOptions options) : session(std::move(options)) {}

    /// Runs a call; a fault that leaves the session alive is remembered, in case the program ends because of it.
    template <class Body>
    void guard(Body body)
    {
        try
        {
            body();
            session.count_bytes();
        }
        catch (CouplingError const& error)
        {
            session.note_fault(error.what());
            throw;
        }
    }

    session::ClientSession session;
};

Client::Client(ClientOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;

Welcome const& Client::connect(FluidProperties const& fluid)
{
    impl_->guard([&] { impl_->session.connect(fluid); });
    return impl_->session.welcome();
}

void Client::send_mesh(MeshView const& mesh)
{
    impl_->guard([&] { impl_->session.send_mesh(mesh); });
}

SolidFields const& Client::begin_step(Step const& step, FluidFields const& fluid, std::vector<Monitor> const& monitors)
{
    impl_->guard([&] { impl_->session.begin_step(step, fluid, monitors); });
    return impl_->session.solid().fields;
}

SolidFields const& Client::iterate_step(FluidFields const& estimate, double residual)
{
    impl_->guard([&] { impl_->session.iterate_step(estimate, residual); });
    return impl_->session.solid().fields;
}

void Client::end_step(Timings const& timings, double residual)
{
    impl_->guard([&] { impl_->session.end_step(timings, residual); });
}

SavedCheckpoint Client::save_checkpoint(double time, std::int64_t complete_step)
{
    SavedCheckpoint saved;
    impl_->guard([&] { saved = impl_->session.save_checkpoint({time, complete_step}); });
    return saved;
}

void Client::finish(std::string const& reason)
{
    impl_->guard([&] { impl_->session.finish(reason); });
}

void Client::abort(std::string const& reason) noexcept
{
    impl_->session.abort(reason);
}

std::optional<std::string> const& Client::stop_request() const
{
    return impl_->session.solid().stop_request;
}
SolidFields const& Client::solid() const
{
    return impl_->session.solid().fields;
}
Welcome const& Client::welcome() const
{
    return impl_->session.welcome();
}
ExchangeTimes const& Client::exchange_times() const
{
    return impl_->session.exchange_times();
}
std::string const& Client::shared_memory_note() const
{
    return impl_->session.shared_memory_note();
}

}  // namespace gimdem::coupling

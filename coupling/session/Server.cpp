// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/Server.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "message/Greeting.hpp"
#include "message/MeshMessage.hpp"
#include "message/StepMessages.hpp"
#include "session/Options.hpp"
#include "session/Session.hpp"
#include "session/SharedFields.hpp"
#include "session/StepOrder.hpp"

namespace gimdem::coupling
{

using session::Event;
using session::State;
using transport::Clock;
using transport::seconds_between;
using transport::ticks;
using transport::Time;

bool ClientInfo::wants_field(std::string const& field_name) const
{
    return std::find(wants.begin(), wants.end(), field_name) != wants.end();
}

struct Server::Impl
{
    explicit Impl(ServerOptions given);

    ClientInfo wait_for_client(ServerTerms const& offered);
    Mesh receive_mesh();
    void accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells);
    void reject_mesh(std::string const& why);
    std::optional<FluidState> receive_fluid();
    void complete(FluidState& fluid);
    void send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells);
    void request_stop(std::string const& reason);

    session::Letter receive(std::string const& awaited);
    bool said_goodbye(session::Letter const& letter);
    void check_order(Step const& step);
    std::optional<std::string> stop_reason();

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
            session.note(error.what());
            throw;
        }
    }

    ServerOptions options;
    message::Terms terms;
    session::SharedFields shared;    ///< outlives the messages that lie in it
    message::Message fluid_message;  ///< holds the bytes that the spans of the last FluidState show
    session::StepOrder order;
    std::string goodbye_reason;
    double busy_before = 0;  ///< the last fluid lay here unread for so long [s]
    Time handed_out;         ///< when receive_fluid() returned
    std::mutex stop_mutex;   ///< request_stop() may come from another thread
    std::optional<std::string> stop;
    session::Session session;
};

Server::Impl::Impl(ServerOptions given)
    : options(std::move(given)), session(transport::Role::server, options.name, options.timeout)
{
    session::require_name(options.name, "ServerOptions.name");
    session::require_seconds(options.timeout, message::min_timeout, "ServerOptions.timeout");
    session::require_seconds(options.connect_time, 0, "ServerOptions.connect_time");
    session::require_seconds(options.step_time, message::min_timeout, "ServerOptions.step_time");
    session.open(transport::Socket::bind(options.endpoint));
    shared.want(options.shared_memory && session.is_ipc());
}

ClientInfo Server::Impl::wait_for_client(ServerTerms const& offered)
{
    session.require(Event::wait_for_client);
    terms.fluid = message::choose_fluid_fields(offered.needs, Fault::user);

    if (!session.wait_for_contact(Clock::now() + ticks(options.connect_time)))
        session.fail(Fault::timeout, "no client has appeared at " + session.endpoint() + " within " +
                                         session::seconds_text(options.connect_time) +
                                         " (the fluid solver did not start, or uses another endpoint); start it with "
                                         "the same endpoint, or allow more time");
    session::Letter const letter = receive("Hello");
    message::Hello const hello = session.read([&] { return message::unpack_hello(letter.message); });
    session.set_peer_name(hello.name);
    session.choose_session_number();
    terms.encodings = both(options.encodings, hello.encodings);
    terms.solid = message::choose_solid_fields(hello.wants, Fault::protocol);

    message::Message welcome = message::pack(Welcome{
        options.name, offered.title, hello.schedule.value_or(offered.schedule), offered.end_time, offered.needs,
                terms.encodings});
    shared.offer(welcome);
    shared.agree(letter.message);
    session.send(std::move(welcome));
    return {hello.name, hello.fluid, hello.wants, hello.schedule};
}

Mesh Server::Impl::receive_mesh()
{
    session.require(Event::receive_mesh);
    session::Letter const letter = receive("Mesh");
    if (said_goodbye(letter))
        throw CouplingError(Fault::peer,
                            session.peer_name() + " said goodbye before it sent its mesh: " + goodbye_reason);
    session.use(session.read(
        [&] { return shared.map_announced(letter.message); }));  // first, so that no fault leaves its name behind
    Mesh mesh = session.read([&] { return message::unpack_mesh(letter.message); });
    terms.cell_count = static_cast<std::size_t>(mesh.cell_count);
    return mesh;
}

void Server::Impl::accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells)
{
    session.require(Event::accept_mesh);
    message::Message solid = message::pack(message::SolidState{initial, timings, 0, stop_reason(), cells}, terms);
    terms.needed = cells.needed;
    session.look_for_trouble("the judgement of the mesh by its program");
    session.advance(Event::accept_mesh);
    message::Message accepted = message::pack_mesh_accepted(static_cast<std::int32_t>(terms.cell_count));
    shared.confirm(accepted);
    shared.announce(accepted, message::shared_bytes(terms.solid, terms.cell_count, terms.encodings.sparse));
    session.send(std::move(accepted));
    session.send(std::move(solid));
}

void Server::Impl::reject_mesh(std::string const& why)
{
    session.require(Event::reject_mesh);
    session.abort(Fault::mesh, why);
}

std::optional<FluidState> Server::Impl::receive_fluid()
{
    Time const entered = Clock::now();
    session.require(Event::receive_fluid);
    if (session.state() == State::finished) return std::nullopt;

    session::Letter letter = receive("FluidState");
    if (said_goodbye(letter)) return std::nullopt;

    session.set_step(letter.message.envelope.step());
    session.read([&] { shared.attach(letter.message); });
    FluidState fluid = session.read([&] { return message::unpack_fluid_state(letter.message, terms); });
    check_order(fluid.step);
    if (auto outbox = shared.use_if_confirmed(letter.message, terms.memory)) session.use(std::move(outbox));
    fluid_message = std::move(letter.message);
    busy_before = std::max(0.0, seconds_between(letter.arrival, entered));
    handed_out = Clock::now();
    return fluid;
}

void Server::Impl::complete(FluidState& fluid)
{
    if (fluid.is_complete) return;
    session.require(Event::complete);
    session.advance(Event::complete);
    session.send(message::pack_fluid_wanted());
    session::Letter letter = receive("the whole FluidState");
    session.read([&] { shared.attach(letter.message); });
    FluidState whole = session.read([&] { return message::unpack_fluid_state(letter.message, terms); });
    bool const is_same = whole.step.number == fluid.step.number && whole.step.time == fluid.step.time &&
                         whole.step.dt == fluid.step.dt;
    if (!is_same || !whole.is_complete)
        session.fail(Fault::protocol, message::describe(letter.message) + " from " + session.peer_name() +
                                          " is not the whole fluid of step " + std::to_string(fluid.step.number) +
                                          " that was asked for; see docs/protocol.md");
    fluid.fields = whole.fields;
    fluid.is_complete = true;
    fluid_message = std::move(letter.message);
}

void Server::Impl::send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells)
{
    double const busy = busy_before + seconds_between(handed_out, Clock::now());
    session.require(Event::send_solid);
    message::Message solid = message::lay_out(message::SolidState{fields, timings, busy, stop_reason(), cells}, terms);
    session.prepare(solid);
    session.look_for_trouble("the solid of its program");
    session.advance(Event::send_solid);
    session.send(std::move(solid));
    terms.memory.message_sent();
    terms.needed = cells.needed;
}

void Server::Impl::request_stop(std::string const& reason)
{
    std::lock_guard<std::mutex> const lock(stop_mutex);
    stop = reason;
}

std::optional<std::string> Server::Impl::stop_reason()
{
    std::lock_guard<std::mutex> const lock(stop_mutex);
    return stop;
}

session::Letter Server::Impl::receive(std::string const& awaited)
{
    return session.receive(awaited, Clock::now() + ticks(options.step_time), options.step_time);
}

bool Server::Impl::said_goodbye(session::Letter const& letter)
{
    if (letter.message.kind() != message::Kind::kGoodbye) return false;
    goodbye_reason = message::unpack_goodbye(letter.message);
    return true;
}

void Server::Impl::check_order(Step const& step)
{
    if (auto const fault = order.find_fault(step))
        session.fail(Fault::protocol, "FluidState from " + session.peer_name() + " is out of order: " + *fault +
                                          "; check how the client counts its steps and its time");
    order.accept(step);
}

Server::Server(ServerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Server::~Server() = default;
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;

std::string const& Server::endpoint() const
{
    return impl_->session.endpoint();
}

ClientInfo Server::wait_for_client(ServerTerms const& terms)
{
    return impl_->guard([&] { return impl_->wait_for_client(terms); });
}

Mesh Server::receive_mesh()
{
    return impl_->guard([&] { return impl_->receive_mesh(); });
}

void Server::accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells)
{
    impl_->guard([&] { impl_->accept_mesh(initial, timings, cells); });
}

void Server::reject_mesh(std::string const& why)
{
    impl_->guard([&] { impl_->reject_mesh(why); });
}

std::optional<FluidState> Server::receive_fluid()
{
    return impl_->guard([&] { return impl_->receive_fluid(); });
}

std::string const& Server::goodbye_reason() const
{
    return impl_->goodbye_reason;
}

void Server::complete(FluidState& fluid)
{
    impl_->guard([&] { impl_->complete(fluid); });
}

void Server::send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells)
{
    impl_->guard([&] { impl_->send_solid(fields, timings, cells); });
}

void Server::abort(std::string const& reason) noexcept
{
    impl_->session.abort(Fault::user, reason);
}

void Server::request_stop(std::string const& reason)
{
    impl_->request_stop(reason);
}

double Server::bytes() const
{
    return impl_->session.bytes();
}

std::string const& Server::shared_memory_note() const
{
    return impl_->shared.note();
}

}  // namespace gimdem::coupling

// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/Client.hpp"

#include <algorithm>
#include <utility>

#include "message/Greeting.hpp"
#include "message/MeshMessage.hpp"
#include "message/StepMessages.hpp"
#include "session/ExchangeClock.hpp"
#include "session/Options.hpp"
#include "session/Session.hpp"
#include "session/SharedFields.hpp"

namespace gimdem::coupling
{

using session::Event;
using session::State;
using transport::Clock;
using transport::ticks;
using transport::Time;

bool Welcome::needs_field(std::string const& name) const
{
    return std::find(needs.begin(), needs.end(), name) != needs.end();
}

struct Client::Impl
{
    explicit Impl(ClientOptions given);

    void connect(FluidProperties const& properties);
    void send_mesh(MeshView const& mesh);
    void begin_step(Step const& step, FluidFields const& fields, std::vector<Monitor> const& monitors);
    void end_step(Timings const& timings);
    void finish(std::string const& reason);

    session::Letter receive(std::string const& awaited);
    Time take_solid();
    void send_whole_fluid();
    bool is_serial() const { return welcome.schedule == Schedule::serial; }

    /// Runs a call; a fault that leaves the session alive is remembered, in case the program ends because of it.
    template <class Body>
    void guard(Body body)
    {
        try
        {
            body();
            clock.set_bytes(session.bytes());
        }
        catch (CouplingError const& error)
        {
            session.note(error.what());
            throw;
        }
    }

    ClientOptions options;
    Welcome welcome;
    message::Terms terms;
    session::SharedFields shared;    ///< outlives the messages that lie in it
    message::Message solid_message;  ///< holds the bytes that the spans of solid show
    message::SolidState solid;
    FluidState fluid;  ///< of begin_step() while it lasts, in case the server wants all of it
    Timings previous;  ///< of the last fluid step
    std::int64_t step = 0;
    session::ExchangeClock clock;
    session::Session session;
};

Client::Impl::Impl(ClientOptions given)
    : options(std::move(given)), session(transport::Role::client, options.name, options.timeout)
{
    session::require_name(options.name, "ClientOptions.name");
    session::require_seconds(options.timeout, message::min_timeout, "ClientOptions.timeout");
    session::require_seconds(options.connect_time, 0, "ClientOptions.connect_time");
    session::require_seconds(options.step_time, message::min_timeout, "ClientOptions.step_time");
    if (options.wants.empty()) options.wants = {field::void_fraction, field::drag_coefficient, field::drag_momentum};
    terms.solid = message::choose_solid_fields(options.wants, Fault::user);
}

void Client::Impl::connect(FluidProperties const& properties)
{
    session.require(Event::connect);
    session.open(transport::Socket::connect(options.endpoint));
    session.advance(Event::connect);
    shared.want(options.shared_memory && session.is_ipc());
    message::Message hello =
        message::pack(message::Hello{options.name, properties, options.wants, options.schedule, options.timeout, options.encodings});
    shared.offer(hello);
    session.send(std::move(hello));

    if (!session.wait_for_contact(Clock::now() + ticks(options.connect_time)))
        session.fail(Fault::endpoint, "no server has answered at " + options.endpoint + " within " +
                                          session::seconds_text(options.connect_time) +
                                          " (none runs there, or it is not a gimdem server); start gimdem-server with "
                                          "the same endpoint");
    session::Letter const letter = receive("Welcome");
    welcome = session.read([&] { return message::unpack_welcome(letter.message); });
    session.set_peer_name(welcome.server);
    shared.agree(letter.message);
    terms.encodings = both(welcome.encodings, options.encodings);
    terms.fluid = session.read([&] { return message::choose_fluid_fields(welcome.needs, Fault::protocol); });
}

void Client::Impl::send_mesh(MeshView const& mesh)
{
    session.require(Event::send_mesh);
    message::Message message = message::pack(mesh);
    session.look_for_trouble("the mesh of its program");
    session.advance(Event::send_mesh);
    terms.cell_count = static_cast<std::size_t>(mesh.cell_count);
    shared.announce(message, message::shared_bytes(terms.fluid, terms.cell_count, terms.encodings.sparse));
    session.send(std::move(message));

    session::Letter const letter = receive("MeshAccepted");
    session.read([&] { message::check_mesh_accepted(letter.message, mesh.cell_count); });
    session.use(shared.use_if_confirmed(letter.message, terms.memory));
    session.use(session.read([&] { return shared.map_announced(letter.message); }));
    take_solid();
}

void Client::Impl::begin_step(Step const& next, FluidFields const& fields, std::vector<Monitor> const& monitors)
{
    Time const entered = Clock::now();
    Event const call = is_serial() ? Event::begin_serial_step : Event::begin_overlapped_step;
    session.require(call);

    ExchangeTimes const& so_far = clock.times();
    fluid = {next, fields, monitors, previous, so_far.exchange, so_far.waiting, true};
    message::Message message = message::lay_out(fluid, terms);
    shared.confirm(message);
    session.prepare(message);
    session.look_for_trouble("the fluid of its program");
    step = next.number;
    session.set_step(step);
    session.advance(call);
    session.send(std::move(message));
    terms.memory.message_sent();
    clock.sent(entered, Clock::now());

    if (!is_serial()) return;
    take_solid();
    clock.answered_serial(Clock::now(), solid.busy_time);
}

void Client::Impl::end_step(Timings const& timings)
{
    Time const entered = Clock::now();
    session.require(Event::end_step);
    session.advance(Event::end_step);
    previous = timings;

    if (is_serial()) return;
    Time const arrival = take_solid();
    clock.answered_overlapped(entered, arrival, Clock::now(), solid.busy_time);
}

void Client::Impl::finish(std::string const& reason)
{
    session.require(Event::finish);
    bool const greeted = session.state() != State::created && session.state() != State::finished;
    if (greeted) session.send(message::pack_goodbye(reason));
    session.advance(Event::finish);
    session.close();
}

session::Letter Client::Impl::receive(std::string const& awaited)
{
    return session.receive(awaited, Clock::now() + ticks(options.step_time), options.step_time);
}

/// Receives the solid of the current step; returns when it arrived.
Time Client::Impl::take_solid()
{
    std::string const awaited = "SolidState of step " + std::to_string(step);
    session::Letter letter = receive(awaited);
    while (letter.message.kind() == message::Kind::kFluidWanted)
    {
        send_whole_fluid();
        letter = receive(awaited);
    }
    if (letter.message.envelope.step() != step)
        session.fail(Fault::protocol, message::describe(letter.message) + " from " + session.peer_name() +
                                          " is out of order (it should answer step " + std::to_string(step) +
                                          "); the two programs do not fit together, see docs/protocol.md");
    session.read([&] { shared.attach(letter.message); });
    solid = session.read([&] { return message::unpack_solid_state(letter.message, terms); });
    terms.needed = solid.cells.needed;
    solid_message = std::move(letter.message);
    return letter.arrival;
}

void Client::Impl::send_whole_fluid()
{
    terms.needed.clear();
    message::Message message = message::lay_out(fluid, terms);
    shared.confirm(message);
    session.prepare(message);
    session.send(std::move(message));
    terms.memory.message_sent();
}

Client::Client(ClientOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;

Welcome const& Client::connect(FluidProperties const& fluid)
{
    impl_->guard([&] { impl_->connect(fluid); });
    return impl_->welcome;
}

void Client::send_mesh(MeshView const& mesh)
{
    impl_->guard([&] { impl_->send_mesh(mesh); });
}

SolidFields const& Client::begin_step(Step const& step, FluidFields const& fluid, std::vector<Monitor> const& monitors)
{
    impl_->guard([&] { impl_->begin_step(step, fluid, monitors); });
    return impl_->solid.fields;
}

void Client::end_step(Timings const& timings)
{
    impl_->guard([&] { impl_->end_step(timings); });
}

void Client::finish(std::string const& reason)
{
    impl_->guard([&] { impl_->finish(reason); });
}

void Client::abort(std::string const& reason) noexcept
{
    impl_->session.abort(Fault::user, reason);
}

std::optional<std::string> const& Client::stop_request() const
{
    return impl_->solid.stop_request;
}
SolidFields const& Client::solid() const
{
    return impl_->solid.fields;
}
Welcome const& Client::welcome() const
{
    return impl_->welcome;
}
ExchangeTimes const& Client::exchange_times() const
{
    return impl_->clock.times();
}
std::string const& Client::shared_memory_note() const
{
    return impl_->shared.note();
}

}  // namespace gimdem::coupling

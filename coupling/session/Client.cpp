// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/Client.hpp"

#include <algorithm>
#include <utility>

#include "gimdem/coupling/Status.hpp"
#include "message/CheckpointMessages.hpp"
#include "message/Greeting.hpp"
#include "message/MeshMessage.hpp"
#include "message/StepMessages.hpp"
#include "session/ClientRecord.hpp"
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
    SavedCheckpoint save_checkpoint(CheckpointRequest const& request);
    void iterate_step(FluidFields const& estimate, double residual);
    void end_step(Timings const& timings, double residual);
    void send_fluid(Event call, FluidState const& given, Time entered);
    Event begin_event() const;
    void finish(std::string const& reason);

    void check_rank_endpoints();
    session::Letter receive(std::string const& awaited);
    Time take_solid();
    void send_whole_fluid();
    bool overlaps() const { return welcome.schedule == Schedule::overlapped; }

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
            record.log().write(LogLevel::error, "fault", error.what());
            throw;
        }
    }

    ClientOptions options;
    std::optional<transport::ClientKeys> keys;
    Welcome welcome;
    message::Terms terms;
    session::SharedFields shared;    ///< outlives the messages that lie in it
    message::Message solid_message;  ///< holds the bytes that the spans of solid show
    message::SolidState solid;
    FluidState fluid;              ///< that was sent last, while its spans live: the server may want all of it
    Timings previous;              ///< of the last fluid step
    double previous_residual = 0;  ///< of the last pass of the step before
    Step step;
    int pass = 0;  ///< of this step
    session::ExchangeClock clock;
    session::ClientRecord record;
    Time fluid_leaves;  ///< that of this step does not before: the clocks' offset is bounded by it
    session::Session session;
};

Client::Impl::Impl(ClientOptions given)
    : options(std::move(given)),
      session(transport::Role::client, session::name_of_rank(options.name, options.rank), options.timeout)
{
    session::require_name(options.name, "ClientOptions.name");
    session::require_rank(options.rank);
    session::require_seconds(options.timeout, message::min_timeout, "ClientOptions.timeout");
    session::require_seconds(options.connect_time, 0, "ClientOptions.connect_time");
    session::require_seconds(options.step_time, message::min_timeout, "ClientOptions.step_time");
    if (!options.keys.empty()) keys = transport::read_client_keys(options.keys);
    if (options.wants.empty()) options.wants = {field::void_fraction, field::drag_coefficient, field::drag_momentum};
    terms.solid = message::choose_solid_fields(options.wants, Fault::user);
}

void Client::Impl::connect(FluidProperties const& properties)
{
    session.require(Event::connect);
    session.open(transport::Socket::connect(options.endpoint, keys));
    session.advance(Event::connect);
    shared.want(options.shared_memory && session.is_ipc());
    message::Message hello = message::pack(message::Hello{.name = options.name,
                                                          .fluid = properties,
                                                          .wants = options.wants,
                                                          .schedule = options.schedule,
                                                          .timeout = options.timeout,
                                                          .resume = options.resume,
                                                          .iterates = options.iterates,
                                                          .rank = options.rank,
                                                          .encodings = options.encodings});
    shared.offer(hello);
    record.stamp(hello);
    Time const hello_sent = Clock::now();
    session.send(std::move(hello));

    if (!session.wait_for_contact(Clock::now() + ticks(options.connect_time)))
        session.fail(Fault::endpoint, "no server has answered at " + options.endpoint + " within " +
                                          session::seconds_text(options.connect_time) + session.connection_note() +
                                          " (none runs there, or it is not a gimdem server); start gimdem-server with "
                                          "the same endpoint");
    session::Letter const letter = receive("Welcome");
    welcome = session.read([&] { return message::unpack_welcome(letter.message); });
    session.set_peer_name(welcome.server);
    check_rank_endpoints();
    shared.agree(letter.message);
    terms.encodings = both(welcome.encodings, options.encodings);
    session.read([&] { record.heard(letter.message, hello_sent, letter.arrival); });
    terms.fluid = session.read([&] { return message::choose_fluid_fields(welcome.needs, Fault::protocol); });
    record.log().write(LogLevel::info, "connected", "connected to " + welcome.server,
                       {{"endpoint", options.endpoint},
                        {"title", welcome.title},
                        {"schedule", name_of(welcome.schedule)},
                        {"clock_offset_s", record.offset() ? record.offset()->offset : not_known},
                        {"clock_uncertainty_s", record.offset() ? record.offset()->uncertainty : not_known}});
}

void Client::Impl::send_mesh(MeshView const& mesh)
{
    session.require(Event::send_mesh);
    message::Message message = message::pack(mesh);
    session.look_for_trouble("the mesh of its program");
    session.advance(Event::send_mesh);
    terms.cell_count = static_cast<std::size_t>(mesh.cell_count);
    session.limit_arrays(message::field_bytes(terms.solid, terms.cell_count));
    shared.announce(message, message::shared_bytes(terms.fluid, terms.cell_count, terms.encodings.sparse));
    session.send(std::move(message));

    session::Letter const letter = receive("MeshAccepted");
    session.read([&] { message::check_mesh_accepted(letter.message, mesh.cell_count); });
    session.use(shared.use_if_confirmed(letter.message, terms.memory));
    session.use(session.read([&] { return shared.map_announced(letter.message); }),
                [this](message::Message& solid_to_be, std::size_t packed)
                { message::take_in(solid_to_be, packed, terms.solid, terms.cell_count, terms.store); });
    take_solid();
    record.log().write(LogLevel::info, "mesh_accepted", "the server holds the mesh",
                       {{"cells", static_cast<double>(mesh.cell_count)}});
}

void Client::Impl::begin_step(Step const& next, FluidFields const& fields, std::vector<Monitor> const& monitors)
{
    ExchangeTimes const& so_far = clock.times();
    send_fluid(begin_event(), {next, fields, monitors, previous, so_far.exchange, so_far.waiting, 0, previous_residual},
               Clock::now());
}

void Client::Impl::iterate_step(FluidFields const& estimate, double residual)
{
    ExchangeTimes const& so_far = clock.times();
    send_fluid(Event::iterate_step, {step, estimate, {}, previous, so_far.exchange, so_far.waiting, pass + 1, residual},
               Clock::now());
}

Event Client::Impl::begin_event() const
{
    switch (welcome.schedule)
    {
        case Schedule::overlapped:
            return Event::begin_overlapped_step;
        case Schedule::iterated:
            return Event::begin_iterated_step;
        default:
            return Event::begin_serial_step;
    }
}

/// Sends a fluid and, unless both compute at once, takes its answer.
void Client::Impl::send_fluid(Event call, FluidState const& given, Time entered)
{
    session.require(call);
    session.announce_soon();
    if (call == Event::iterate_step) record.ended(entered, entered, 0);
    fluid = given;
    message::Message message = message::lay_out(fluid, terms);
    shared.confirm(message);
    record.put_into_fluid(message);
    session.prepare(message);
    session.look_for_trouble("the fluid of its program");
    step = fluid.step;
    pass = fluid.pass;
    session.set_step(step.number);
    session.advance(call);
    fluid_leaves = Clock::now();
    session.send(std::move(message));
    terms.memory.message_sent();
    Time const fluid_sent = Clock::now();
    clock.sent(entered, fluid_sent);
    record.began(step.number, entered, fluid_sent);

    if (overlaps()) return;
    Time const arrival = take_solid();
    Time const left = Clock::now();
    double const waiting = clock.answered_serial(left, solid.busy_time);
    record.began(step.number, entered, left);
    record.waited_in_begin(fluid_sent, arrival, waiting);
}

void Client::Impl::end_step(Timings const& timings, double residual)
{
    Time const entered = Clock::now();
    session.require(Event::end_step);
    session.advance(Event::end_step);
    previous = timings;
    previous_residual = residual;

    if (!overlaps()) return record.ended(entered, Clock::now(), 0);
    Time const arrival = take_solid();
    Time const left = Clock::now();
    record.ended(entered, left, clock.answered_overlapped(entered, arrival, left, solid.busy_time));
}

SavedCheckpoint Client::Impl::save_checkpoint(CheckpointRequest const& request)
{
    session.require(Event::save_checkpoint);
    if (!welcome.saves_checkpoints)
        throw CouplingError(Fault::user, session.peer_name() +
                                             " saves no checkpoints when asked (Welcome::saves_checkpoints tells); "
                                             "do not ask for one");
    message::Message message = message::pack(request);
    session.look_for_trouble("the fluid of its program");
    session.advance(Event::save_checkpoint);
    session.send(std::move(message));
    session::Letter const letter = receive("CheckpointSaved");
    return session.read([&] { return message::unpack_saved_checkpoint(letter.message); });
}

void Client::Impl::finish(std::string const& reason)
{
    session.require(Event::finish);
    bool const greeted = session.state() != State::created && session.state() != State::finished;
    message::Message goodbye = message::pack_goodbye(reason);
    record.put_into_goodbye(goodbye, previous);
    if (greeted) session.send(std::move(goodbye));
    record.log().write(LogLevel::info, "finished", reason,
                       {{"steps", static_cast<double>(step.number)},
                        {"exchange_s", clock.times().exchange},
                        {"waiting_s", clock.times().waiting},
                        {"bytes", clock.times().bytes}});
    session.advance(Event::finish);
    session.close();
}

/// A server of protocol 1.0 would take rank 0 for the whole client.
void Client::Impl::check_rank_endpoints()
{
    auto const expected = static_cast<std::size_t>(options.rank.number == 0 ? options.rank.count - 1 : 0);
    if (welcome.rank_endpoints.size() == expected) return;
    session.fail(Fault::version, session.peer_name() + " told endpoints for " +
                                     std::to_string(welcome.rank_endpoints.size()) + " more ranks instead of " +
                                     std::to_string(expected) + "; update it, or run one process");
}

session::Letter Client::Impl::receive(std::string const& awaited)
{
    return session.receive(awaited, Clock::now() + ticks(options.step_time), options.step_time);
}

/// Receives the solid of the current step; returns when it arrived.
Time Client::Impl::take_solid()
{
    std::string const awaited =
        "step " + std::to_string(step.number) + (pass > 0 ? ", pass " + std::to_string(pass) : "");
    session::Letter letter = receive("SolidState of " + awaited);
    while (letter.message.kind() == message::Kind::kFluidWanted)
    {
        send_whole_fluid();
        letter = receive("SolidState of " + awaited);
    }
    v1::Envelope const& envelope = letter.message.envelope;
    if (envelope.step() != step.number || envelope.iteration() != pass)
        session.fail(Fault::protocol, message::describe(letter.message) + " from " + session.peer_name() +
                                          " is out of order (it should answer " + awaited +
                                          "); the two programs do not fit together, see docs/protocol.md");
    session.read([&] { shared.attach(letter.message); });
    solid = session.read([&] { return message::unpack_solid_state(letter.message, terms); });
    session.read([&] { record.heard(letter.message, fluid_leaves, letter.arrival); });
    terms.needed = solid.cells.needed;
    solid_message = std::move(letter.message);
    return letter.arrival;
}

/// The same fluid again, with all cells.
void Client::Impl::send_whole_fluid()
{
    terms.needed.clear();
    message::Message message = message::lay_out(fluid, terms);
    shared.confirm(message);
    record.put_into_fluid(message);
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

SolidFields const& Client::iterate_step(FluidFields const& estimate, double residual)
{
    impl_->guard([&] { impl_->iterate_step(estimate, residual); });
    return impl_->solid.fields;
}

void Client::end_step(Timings const& timings, double residual)
{
    impl_->guard([&] { impl_->end_step(timings, residual); });
}

SavedCheckpoint Client::save_checkpoint(double time, std::int64_t complete_step)
{
    SavedCheckpoint saved;
    impl_->guard([&] { saved = impl_->save_checkpoint({time, complete_step}); });
    return saved;
}

void Client::finish(std::string const& reason)
{
    impl_->guard([&] { impl_->finish(reason); });
}

void Client::abort(std::string const& reason) noexcept
{
    try
    {
        impl_->record.log().write(LogLevel::error, "aborted", reason);
    }
    catch (std::exception const&)
    {
        // The log is of no use to a program that is out of memory.
    }
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

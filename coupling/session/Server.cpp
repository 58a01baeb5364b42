// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/Server.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "message/CheckpointMessages.hpp"
#include "message/ClockMessages.hpp"
#include "message/Greeting.hpp"
#include "message/MeshMessage.hpp"
#include "message/StepMessages.hpp"
#include "session/Exchange.hpp"
#include "session/Options.hpp"
#include "session/Ranks.hpp"
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

struct Server::Impl : session::Exchange
{
    /// expected: which rank must come; empty for rank 0, which tells how many there are.
    explicit Impl(ServerOptions given, std::optional<Rank> expected = std::nullopt);

    std::string const& endpoint() const override { return session.endpoint(); }
    ClientInfo wait_for_client(ServerTerms const& offered) override;
    Mesh receive_mesh() override;
    void accept_mesh(SolidFields const& initial, Timings const& timings) override;
    std::optional<FluidState> receive_fluid() override;
    void send_solid(SolidFields const& fields, Timings const& timings) override;
    void request_stop(std::string const& reason) override;
    void abort(Fault fault, std::string const& reason) noexcept override { session.abort(fault, reason); }
    std::string const& goodbye_reason() const override { return goodbye; }
    std::string const& shared_memory_note() const override { return shared.note(); }
    double bytes() const override { return session.bytes(); }
    void set_watch(std::function<void()> watch) override { session.set_watch(std::move(watch)); }
    void look_for_loss() override { session.look_for_loss("all ranks"); }
    bool has_failed() const override { return session.state() == State::failed; }

    /// Of several ranks, rank 0 asks for all.
    bool saves_checkpoints() const { return saver && !expected_rank; }
    void wait_for_contact();
    void check_rank(Rank const& rank);
    void listen_for_others(Rank const& first);
    /// The whole client: this process, or all ranks.
    session::Exchange& whole()
    {
        if (ranks) return *ranks;
        return *this;
    }
    session::Exchange const& whole() const { return const_cast<Impl*>(this)->whole(); }

    session::Letter receive(std::string const& awaited);
    void complete(FluidState& fluid);
    void save_checkpoint(session::Letter const& letter);
    void wake_client();
    bool said_goodbye(session::Letter const& letter);
    void check_order(FluidState const& fluid);
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
    CheckpointSaver saver;
    session::SharedFields shared;    ///< outlives the messages that lie in it
    message::Message fluid_message;  ///< holds the bytes that the spans of the last FluidState show
    session::StepOrder order;
    bool iterates = false;  ///< the schedule iterated is in force
    int pass = 0;           ///< of the fluid that is being answered
    std::string goodbye;
    StepCells cells;         ///< of the solid that is sent next
    double busy_before = 0;  ///< the last fluid lay here unread for so long [s]
    Time handed_out;         ///< when receive_fluid() returned
    double waking = 0;       ///< what it took since then to wake the client up [s]
    ServerTimes times;       ///< of the last step
    std::optional<LastClientStep> last_client_step;
    std::mutex stop_mutex;  ///< request_stop() may come from another thread
    std::optional<std::string> stop;
    std::optional<Rank> expected_rank;
    session::Session session;
    std::unique_ptr<session::Ranks> ranks;  ///< null: the client is one process
};

Server::Impl::Impl(ServerOptions given, std::optional<Rank> expected)
    : options(std::move(given)),
      expected_rank(expected),
      session(transport::Role::server, options.name, options.timeout)
{
    session::require_name(options.name, "ServerOptions.name");
    session::require_seconds(options.timeout, message::min_timeout, "ServerOptions.timeout");
    session::require_seconds(options.connect_time, 0, "ServerOptions.connect_time");
    session::require_seconds(options.step_time, message::min_timeout, "ServerOptions.step_time");
    std::optional<transport::ServerKeys> keys;
    if (!options.keys.empty()) keys = transport::read_server_keys(options.keys);
    session.open(transport::Socket::bind(options.endpoint, keys), options.log);
    shared.want(options.shared_memory && session.is_ipc());
    if (options.clock_origin == 0) options.clock_origin = clock_now();
}

ClientInfo Server::Impl::wait_for_client(ServerTerms const& offered)
{
    session.require(Event::wait_for_client);
    terms.fluid = message::choose_fluid_fields(offered.needs, Fault::user);

    wait_for_contact();
    session::Letter const letter = receive("Hello");
    message::Hello const hello = session.read([&] { return message::unpack_hello(letter.message); });
    session.set_peer_name(session::name_of_rank(hello.name, hello.rank));
    check_rank(hello.rank);
    if (!expected_rank && hello.rank.count > 1) listen_for_others(hello.rank);
    session.choose_session_number();
    terms.encodings = both(options.encodings, hello.encodings);
    if (hello.rank.count > 1) terms.encodings.sparse = false;  // needs are told by the cells of one process
    terms.solid = message::choose_solid_fields(hello.wants, Fault::protocol);
    Schedule const schedule = hello.schedule.value_or(offered.schedule);
    iterates = schedule == Schedule::iterated;
    if (iterates && !hello.iterates)
        session.fail(Fault::user, "the schedule is iterated, and " + session.peer_name() +
                                      " cannot repeat a step (it does not say so in Hello); choose schedule serial or "
                                      "overlapped, or another client");

    message::Message welcome =
        message::pack(Welcome{.server = options.name,
                              .title = offered.title,
                              .schedule = schedule,
                              .end_time = offered.end_time,
                              .needs = offered.needs,
                              .saves_checkpoints = saves_checkpoints(),
                              .fluid_steps = offered.fluid_steps,
                              .iteration = offered.iteration,
                              .rank_endpoints = ranks ? ranks->endpoints() : std::vector<std::string>(),
                              .encodings = terms.encodings});
    shared.offer(welcome);
    shared.agree(letter.message);
    session.limit_arrays(transport::half_of_memory());
    if (session.read([&] { return message::clock_reading(letter.message); }))
        message::put(
            {transport::on_clock(letter.arrival), clock_now(), options.clock_origin, message::machine_number()},
            welcome);
    session.send(std::move(welcome));
    ClientInfo info{.name = hello.name,
                    .fluid = hello.fluid,
                    .wants = hello.wants,
                    .schedule = hello.schedule,
                    .resume = hello.resume,
                    .iterates = hello.iterates,
                    .ranks = hello.rank.count};
    if (ranks) ranks->wait_for_others(info, offered);
    return info;
}

void Server::Impl::wait_for_contact()
{
    if (session.wait_for_contact(Clock::now() + ticks(options.connect_time))) return;
    std::string const within =
        " has appeared at " + session.endpoint() + " within " + session::seconds_text(options.connect_time);
    if (expected_rank)
        session.fail(Fault::timeout, "no rank " + std::to_string(expected_rank->number) + " of " +
                                         std::to_string(expected_rank->count) + within +
                                         " (rank 0 is there); see why it did not start, or allow more time");
    session.fail(Fault::timeout, "no client" + within +
                                     " (the fluid solver did not start, or uses another endpoint); start it with "
                                     "the same endpoint, or allow more time");
}

void Server::Impl::check_rank(Rank const& rank)
{
    Rank const expected = expected_rank.value_or(Rank{0, rank.count, rank.run});
    if (rank.number == expected.number && rank.count == expected.count && rank.run == expected.run) return;
    std::string const why =
        rank.number == expected.number && rank.count == expected.count
            ? "it belongs to another run"
            : "rank " + std::to_string(expected.number) + " of " + std::to_string(expected.count) + " is due there";
    session.fail(Fault::protocol, session.peer_name() + " has come to the endpoint " + session.endpoint() + ", but " +
                                      why +
                                      " (rank 0 tells the others their endpoints and the number of the run); is "
                                      "an old program still running?");
}

/// Binds an endpoint for each rank but this one.
void Server::Impl::listen_for_others(Rank const& first)
{
    session::Ranks::Parts others;
    for (std::int32_t number = 1; number < first.count; ++number)
    {
        ServerOptions own = options;
        own.endpoint = session::endpoint_of_rank(session.endpoint(), number);
        others.push_back(std::make_unique<Impl>(own, Rank{number, first.count, first.run}));
    }
    ranks = std::make_unique<session::Ranks>(*this, std::move(others));
}

Mesh Server::Impl::receive_mesh()
{
    session.require(Event::receive_mesh);
    session::Letter const letter = receive("Mesh");
    if (said_goodbye(letter))
        throw CouplingError(Fault::peer, session.peer_name() + " said goodbye before it sent its mesh: " + goodbye);
    // First, so that no fault leaves its name behind.
    session.use(session.read([&] { return shared.map_announced(letter.message); }),
                [this](message::Message& fluid, std::size_t packed)
                { message::take_in(fluid, packed, terms.fluid, terms.cell_count, terms.store); });
    Mesh mesh = session.read([&] { return message::unpack_mesh(letter.message); });
    terms.cell_count = static_cast<std::size_t>(mesh.cell_count);
    session.limit_arrays(message::field_bytes(terms.fluid, terms.cell_count));
    return mesh;
}

void Server::Impl::accept_mesh(SolidFields const& initial, Timings const& timings)
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

std::optional<FluidState> Server::Impl::receive_fluid()
{
    Time const entered = Clock::now();
    session.require(Event::receive_fluid);
    if (session.state() == State::finished) return std::nullopt;

    session::Letter letter = receive("FluidState");
    for (; letter.message.kind() == message::Kind::kCheckpoint; letter = receive("FluidState"))
        save_checkpoint(letter);
    if (said_goodbye(letter)) return std::nullopt;

    session.set_step(letter.message.envelope.step());
    session.read([&] { shared.attach(letter.message); });
    FluidState fluid = session.read([&] { return message::unpack_fluid_state(letter.message, terms); });
    check_order(fluid);
    pass = fluid.pass;
    if (auto outbox = shared.use_if_confirmed(letter.message, terms.memory)) session.use(std::move(outbox));
    fluid_message = std::move(letter.message);
    busy_before = std::max(0.0, seconds_between(letter.arrival, entered));
    handed_out = Clock::now();
    times.asked = transport::on_clock(entered);
    times.arrived = transport::on_clock(letter.arrival);
    times.handed_out = transport::on_clock(handed_out);
    if (fluid.clock) session.status_desk().publish(*fluid.clock);
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
                         whole.step.dt == fluid.step.dt && whole.pass == fluid.pass;
    if (!is_same || !whole.is_complete)
        session.fail(Fault::protocol, message::describe(letter.message) + " from " + session.peer_name() +
                                          " is not the whole fluid of step " + std::to_string(fluid.step.number) +
                                          " that was asked for; see docs/protocol.md");
    fluid.fields = whole.fields;
    fluid.is_complete = true;
    fluid_message = std::move(letter.message);
}

void Server::Impl::save_checkpoint(session::Letter const& letter)
{
    CheckpointRequest const request = session.read([&] { return message::unpack_checkpoint_request(letter.message); });
    if (!saves_checkpoints())
        session.fail(Fault::protocol, message::describe(letter.message) + " from " + session.peer_name() +
                                          " is not allowed (this server saves none, as its Welcome told); do not ask "
                                          "for one");
    message::Message answer = message::pack(saver(request));
    session.advance(Event::checkpoint_is_saved);
    session.send(std::move(answer));
}

void Server::Impl::wake_client()
{
    Time const entered = Clock::now();
    session.announce_soon();
    waking += seconds_between(entered, Clock::now());
}

void Server::Impl::send_solid(SolidFields const& fields, Timings const& timings)
{
    times.answering = clock_now();
    double const busy = busy_before + seconds_between(handed_out, Clock::now()) - std::exchange(waking, 0);
    session.require(Event::send_solid);
    session.announce_soon();
    message::Message solid = message::lay_out(message::SolidState{fields, timings, busy, stop_reason(), cells}, terms);
    solid.envelope.set_iteration(pass);
    message::put({times.arrived, times.answering, options.clock_origin, 0}, solid);
    session.prepare(solid);
    session.look_for_trouble("the solid of its program");
    session.advance(Event::send_solid);
    session.send(std::move(solid));
    terms.memory.message_sent();
    terms.needed = cells.needed;
    times.answered = clock_now();
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
    goodbye = message::unpack_goodbye(letter.message);
    last_client_step = session.read([&] { return message::unpack_last_step(letter.message); });
    return true;
}

void Server::Impl::check_order(FluidState const& fluid)
{
    bool const repeats = fluid.pass > 0;
    auto fault = repeats ? order.find_fault_of_repeat(fluid.step, fluid.pass) : order.find_fault(fluid.step);
    if (repeats && !iterates) fault = "it repeats a step, and the schedule is not iterated";
    if (fault)
        session.fail(Fault::protocol, "FluidState from " + session.peer_name() + " is out of order: " + *fault +
                                          "; check how the client counts its steps and its time");
    if (repeats)
        order.accept_repeat(fluid.step, fluid.pass);
    else
        order.accept(fluid.step);
}

Server::Server(ServerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Server::~Server() = default;
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;

std::string const& Server::endpoint() const
{
    return impl_->session.endpoint();
}

void Server::save_checkpoints_by(CheckpointSaver saver)
{
    impl_->saver = std::move(saver);
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
    impl_->cells = cells;
    impl_->guard([&] { impl_->whole().accept_mesh(initial, timings); });
}

void Server::reject_mesh(std::string const& why)
{
    impl_->guard(
        [&]
        {
            impl_->session.require(Event::reject_mesh);
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
    impl_->guard([&] { impl_->complete(fluid); });
}

void Server::wake_client()
{
    if (!impl_->ranks) impl_->wake_client();
}

void Server::send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells)
{
    impl_->cells = cells;
    impl_->guard([&] { impl_->whole().send_solid(fields, timings); });
}

bool Server::has_lost_client() const
{
    return !impl_->ranks && impl_->session.has_lost_peer();
}

std::uint64_t Server::session_number() const
{
    return impl_->session.session_number();
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
    return impl_->times;
}

std::optional<LastClientStep> const& Server::last_client_step() const
{
    return impl_->last_client_step;
}

void Server::publish(RunStatus run)
{
    impl_->session.status_desk().publish(std::move(run));
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

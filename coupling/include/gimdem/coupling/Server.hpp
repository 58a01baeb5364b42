// SPDX-License-Identifier: BSD-3-Clause
/// The particle side of a coupled run.
///
///     Server server({endpoint, "gimdem-server 0.1"});
///     ClientInfo client = server.wait_for_client(terms);   // Hello -> Welcome
///     Mesh mesh = server.receive_mesh();
///     server.accept_mesh(solid_at_zero, timings);          // or reject_mesh(why)
///     while (auto fluid = server.receive_fluid())          // empty at Goodbye
///     {
///         ... move the particles t -> t + dt, map them ...
///         server.send_solid(fields, timings);
///     }
///
/// The schedule is the client's affair: the server always answers a fluid state at t with the solid at t + dt. In the
/// schedule iterated it must be able to go back by one step: FluidState::pass.
/// Each call throws CouplingError on a fault.
///
/// A client of several processes looks like one: its meshes come merged, its fields whole, the ranks' cells one after
/// the other. Every call waits for all ranks.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gimdem/coupling/CellRuns.hpp"
#include "gimdem/coupling/Checkpoint.hpp"
#include "gimdem/coupling/Error.hpp"
#include "gimdem/coupling/Status.hpp"
#include "gimdem/coupling/StepTimes.hpp"
#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling
{

struct ServerOptions
{
    std::string endpoint;       ///< "ipc:///path/socket", "tcp://127.0.0.1:port" or "tcp://127.0.0.1:*" (any free port)
    std::string name;           ///< name and version, told to the client
    double timeout = 30;        ///< a client silent for this long is dead [s]
    double connect_time = 120;  ///< how long to wait for a client [s]
    double step_time = 3600;    ///< longest wait for the next message of a live client [s]
    bool shared_memory = true;  ///< over ipc, let large fields travel through shared memory if the client can
    Encodings encodings{true, false, false};  ///< in force if the client can do them
    std::string keys;  ///< folder of keys, gimdem/coupling/Keys.hpp; empty: none, and this machine only
    /// Told what a user may like to know, such as who was turned away; on another thread, and it must not block.
    std::function<void(std::string const&)> log;
    double clock_origin = 0;  ///< when the run began, by clock_now() [s]; 0: now
};

/// What the case file fixes and the client is told.
struct ServerTerms
{
    std::string title;
    Schedule schedule = Schedule::serial;
    double end_time = 0;                  ///< [s]
    std::vector<std::string> needs = {};  ///< fluid fields to ask for
    int fluid_steps = 1;                  ///< equal fluid steps that a coupling step should have
    Iteration iteration = {};             ///< of schedule iterated
};

/// What Hello told.
struct ClientInfo
{
    std::string name;
    FluidProperties fluid;
    std::vector<std::string> wants;    ///< solid fields the client asks for
    std::optional<Schedule> schedule;  ///< the client's wish, which is then in force; empty: the server's terms are
    std::optional<ResumePoint> resume = {};  ///< where the client goes on; empty: it begins a run
    bool iterates = false;                   ///< it can repeat steps; where that is also in force, it will
    std::int32_t ranks = 1;                  ///< processes that the client consists of
    bool wants_field(std::string const& field_name) const;
};

/// A fluid state as received; spans live until the next receive_fluid.
struct FluidState
{
    Step step;
    FluidFields fields;
    std::vector<Monitor> monitors;
    Timings previous;     ///< how long the client's previous step took
    double exchange = 0;  ///< the client's sum of exchange time so far [s]
    double waiting = 0;   ///< the client's sum of waiting so far [s]
    int pass = 0;         ///< above 0: go back to the beginning of the last step, and repeat it in this fluid
    double residual = 0;  ///< of the pass before, relative; schedule iterated
    ClientTimes previous_times = {};                  ///< when the client's previous step did what; step 0: not told
    std::optional<ClockOffset> clock = std::nullopt;  ///< by the client's latest estimate
    bool is_complete = true;                          ///< false: cells that the last StepCells left out hold 0
};

class Server
{
public:
    /// Binds at once: Fault::endpoint if the address is taken or not allowed (without keys only ipc and loopback tcp
    /// are).
    explicit Server(ServerOptions options);
    ~Server();
    Server(Server&&) noexcept;
    Server& operator=(Server&&) noexcept;

    /// The bound address, with the port chosen for "*".
    std::string const& endpoint() const;

    /// Saves what the program has so far, when the client asks for it; receive_fluid() calls it. What it throws ends
    /// receive_fluid(). Without it, to be set before wait_for_client(), the client cannot ask.
    using CheckpointSaver = std::function<SavedCheckpoint(CheckpointRequest const&)>;
    void save_checkpoints_by(CheckpointSaver saver);

    /// @post Welcome sent; a client of another protocol version is told so and Fault::version is thrown.
    ClientInfo wait_for_client(ServerTerms const& terms);

    /// @pre a client was welcomed. Every count, offset and index is checked before use; geometry is the caller's to
    /// check (reject_mesh).
    Mesh receive_mesh();

    /// @pre receive_mesh. Sends MeshAccepted and the solid at t = 0. Only the fields the client wants are sent.
    void accept_mesh(SolidFields const& initial, Timings const& timings = {}, StepCells const& cells = {});

    /// Refuse the mesh with a reason; the session is over.
    void reject_mesh(std::string const& why);

    /// The next fluid state; empty when the client said Goodbye (its reason: goodbye_reason()).
    std::optional<FluidState> receive_fluid();
    std::string const& goodbye_reason() const;

    /// @pre receive_fluid, and the client keeps to the serial schedule. Asks for the fields of all cells of that fluid;
    /// afterwards it is complete. Takes a round trip.
    void complete(FluidState& fluid);

    /// The solid will be sent in a moment: a client that sleeps beside us may wake up meanwhile. Never needed.
    void wake_client();

    /// @pre receive_fluid. Answers it.
    void send_solid(SolidFields const& fields, Timings const& timings, StepCells const& cells = {});

    /// The session is over because the client, or a rank of it, is gone, silent or slow, not because it said why.
    bool has_lost_client() const;
    /// The session's number, by which a client that goes on names it.
    std::uint64_t session_number() const;

    /// Tell the client why we stop; never throws. The destructor of an unfinished session does it too.
    void abort(std::string const& reason) noexcept;

    /// Ask the client for an orderly end (Ctrl-C here): the next solid carries the reason, Client::stop_request().
    void request_stop(std::string const& reason);

    /// When the last step did what; its answer is that of the step before until send_solid().
    ServerTimes const& step_times() const;
    /// After Goodbye, if the client tells it.
    std::optional<LastClientStep> const& last_client_step() const;

    /// What query_status() answers from now on; cheap enough for every step.
    void publish(RunStatus run);

    /// Bytes received and sent so far, through shared memory too.
    double bytes() const;

    /// For the log, after accept_mesh(): why fields do not travel through shared memory though both sides want it;
    /// empty if there is nothing to tell.
    std::string const& shared_memory_note() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gimdem::coupling

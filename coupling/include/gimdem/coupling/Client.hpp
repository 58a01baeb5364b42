// SPDX-License-Identifier: BSD-3-Clause
/// The CFD side of a coupled run: everything that a fluid solver calls.
///
///     Client client({endpoint, "mySolver"});
///     client.connect(fluid);                         // Hello -> Welcome
///     client.send_mesh(mesh);                        // Mesh -> MeshAccepted, then the solid at t = 0
///     while (...)                                    // both schedules, same loop
///     {
///         auto solid = client.begin_step(step, fluid_fields, monitors);  // solid to use in this fluid step
///         ... solve the fluid t -> t + dt ...
///         client.end_step(timings);
///     }
///     client.finish("end time reached");             // Goodbye
///
/// serial: begin_step sends the fluid at t and returns the solid at t + dt. overlapped: it returns the solid at t at
/// once and both solvers compute; end_step takes the solid at t + dt. Each call throws CouplingError on a fault; an
/// illegal order of calls is Fault::user and names the state. Not thread-safe: one Client, one thread.
/// iterated: as serial, and iterate_step() between the two repeats the step; FixedPoint.hpp shows the loop.
///
/// Several processes (MPI): each has a Client, which sends its part of the mesh and of the fields and gets its part of
/// the solid. Rank 0 connects first; its Welcome tells the endpoints of the others. All make the same calls with the
/// same steps; what ends one of them ends all. The monitors of rank 0 count.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gimdem/coupling/CellRuns.hpp"
#include "gimdem/coupling/Checkpoint.hpp"
#include "gimdem/coupling/Error.hpp"
#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling
{

struct ClientOptions
{
    std::string endpoint;              ///< "ipc:///path/socket" or "tcp://127.0.0.1:port", with keys "tcp://host:port"
    std::string name;                  ///< who we are, for messages and logs
    double timeout = 30;               ///< a peer silent for this long is dead [s]
    double connect_time = 60;          ///< how long connect() waits for a server to appear [s]
    double step_time = 3600;           ///< longest wait for the answer of a live server [s]
    std::optional<Schedule> schedule;  ///< ask for one; left empty, the server's case file decides
    std::vector<std::string> wants;  ///< solid fields to receive; empty: void_fraction, drag_coefficient, drag_momentum
    bool shared_memory = true;       ///< over ipc, let large fields travel through shared memory if the server can
    Encodings encodings{true, true, true};   ///< those that the server may choose
    std::optional<ResumePoint> resume = {};  ///< where to go on; left empty: a run begins
    bool iterates = false;                   ///< the program calls iterate_step() if the schedule is iterated
    Rank rank = {};                          ///< of a fluid that several processes solve together
    std::string keys;  ///< folder of keys, gimdem/coupling/Keys.hpp; empty: none, and this machine only
};

/// The server's answer to Hello.
struct Welcome
{
    std::string server;  ///< name and version of the server
    std::string title;   ///< of the case
    Schedule schedule = Schedule::serial;
    double end_time = 0;                           ///< the run ends here [s]
    std::vector<std::string> needs = {};           ///< fluid fields that this scene needs, names of namespace field
    bool saves_checkpoints = false;                ///< save_checkpoint() is possible
    int fluid_steps = 1;                           ///< equal fluid steps that a coupling step should have
    Iteration iteration = {};                      ///< of schedule iterated
    std::vector<std::string> rank_endpoints = {};  ///< to rank 0 of several: where ranks 1, 2, ... connect
    Encodings encodings = {};                      ///< in force
    bool needs_field(std::string const& name) const;
};

/// What the client measured of the coupling, summed over the run.
struct ExchangeTimes
{
    double exchange = 0;  ///< packing, sending, receiving: the part of a call that is not the server computing [s]
    double waiting = 0;   ///< blocked while the server computes [s]
    double bytes = 0;     ///< sent and received, through shared memory too
};

class Client
{
public:
    explicit Client(ClientOptions options);
    ~Client();
    Client(Client&&) noexcept;
    Client& operator=(Client&&) noexcept;

    /// @pre constructed. @post connected, or CouplingError (endpoint, version, timeout, peer).
    Welcome const& connect(FluidProperties const& fluid);

    /// @pre connected. @post the server holds the mesh, solid() is the state at t = 0; Fault::mesh if it is refused.
    void send_mesh(MeshView const& mesh);

    /// @pre send_mesh() or end_step() has been called. Returns the solid that the fluid step must use; its spans live
    /// until the next begin_step or end_step. Sizes of the fields are checked; a NaN or infinity in what is sent is
    /// Fault::user. Where the server needs only some cells, only these are sent.
    SolidFields const& begin_step(Step const& step, FluidFields const& fluid,
                                  std::vector<Monitor> const& monitors = {});

    /// Schedule iterated: the server goes back to the beginning of the step and repeats it in this estimate of the
    /// fluid at its end. @pre begin_step() or iterate_step() has been called. Returns the solid that the fluid step,
    /// from its own state at t, must use. `residual`: relative, of the pass that is given up, for logs.
    SolidFields const& iterate_step(FluidFields const& estimate, double residual = 0);

    /// @pre begin_step() has been called. timings tells where this fluid step spent its time, residual how well an
    /// iterated one converged.
    void end_step(Timings const& timings = {}, double residual = 0);

    /// @pre send_mesh() or end_step() was the last call, and the server saves checkpoints. Has the server save its
    /// state of now; returns when that is safe on disk. The fluid's state of now belongs to it: write it, then remember
    /// what is returned, for ClientOptions.resume. complete_step: step of the newest checkpoint to which a fluid is
    /// whole, 0: none; the server keeps it until a newer one is complete.
    SavedCheckpoint save_checkpoint(double time, std::int64_t complete_step);

    /// Why the server asks for an orderly end (Ctrl-C there), if it does: write your fields and call finish().
    std::optional<std::string> const& stop_request() const;

    /// The last solid received.
    SolidFields const& solid() const;
    Welcome const& welcome() const;
    ExchangeTimes const& exchange_times() const;
    /// For the log, after send_mesh(): why fields do not travel through shared memory though both sides want it; empty
    /// if there is nothing to tell.
    std::string const& shared_memory_note() const;

    /// Orderly end: Goodbye. Later calls are illegal.
    void finish(std::string const& reason);

    /// Tell the server why we stop; never throws. The destructor of an unfinished Client does it too.
    void abort(std::string const& reason) noexcept;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gimdem::coupling

// SPDX-License-Identifier: BSD-3-Clause
/// A coupled run from its client's mesh to its figures.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/CouplingLog.hpp"
#include "app/RunEvents.hpp"
#include "app/RunLog.hpp"
#include "app/RunObserver.hpp"
#include "core/Case.hpp"
#include "engine/Checkpoint.hpp"
#include "engine/CoupledEngine.hpp"
#include "gimdem/coupling/Server.hpp"
#include "particles/Inlet.hpp"
#include "particles/Materials.hpp"

namespace gimdem::app
{

class CoupledRun
{
public:
    /// Takes the client's mesh; one that is no mesh is refused.
    CoupledRun(Case const& settings, std::filesystem::path const& folder, coupling::Server& server,
               coupling::ClientInfo client, ParticleState particles, Materials const& materials, RunEvents& events,
               output::TraceChoice const& trace);

    /// From a bed, or from a checkpoint, which must be the one that the client goes on from, if it does.
    void start(std::optional<std::filesystem::path> const& restart);

    /// A client has come back: rewinds to its checkpoint. It must be the same client on the same mesh.
    void go_on(coupling::ClientInfo const& client);

    /// Steps until the client says goodbye.
    void couple();

    /// Saves what the client asks for; older checkpoints go where they are of no more use.
    coupling::SavedCheckpoint save(coupling::CheckpointRequest const& request);

    /// Figures and the last state of the particles, whatever ended the run.
    void finish();
    /// The same where the run has failed: what cannot be written any more is told, and nothing is thrown.
    void finish_after_failure() noexcept;

private:
    void settle();
    void warn_of_added_mass();
    void load(std::filesystem::path const& file);
    void accept_mesh();
    void finish_records();
    /// In serial runs the client, which waits, can be asked for the cells that it left out. Empty: there are none.
    std::function<coupling::FluidFields()> whole(coupling::FluidState& fluid);
    /// For the solid of a step that ends at `time` [s], and the fluid of the next one.
    coupling::StepCells cells_to_send(double time);
    /// Returns how long output took [s].
    double begin_step(coupling::FluidState const& fluid, double waited);
    /// The same for a pass after the first.
    double repeat_step(double waited);
    /// The step that was answered last stands.
    void accept();
    void require_same(coupling::ClientInfo const& client) const;
    void check_start(coupling::Step const& first) const;
    bool is_checkpoint_between(double before, double now) const;
    void keep();

    Case const& settings_;
    std::filesystem::path folder_;
    coupling::Server& server_;  ///< serves one client after the other
    RunEvents& events_;
    coupling::ClientInfo client_;
    coupling::Schedule schedule_;
    RunObserver observer_;
    exec::Execution execution_;
    PolyMesh mesh_;
    WallGeometry walls_;
    std::vector<Inlet> inlets_;
    DemSystem system_;
    RunLog log_;
    CouplingLog coupling_log_;
    CoupledEngine engine_;
    RunPoint start_, at_;             ///< in coupling steps
    std::optional<double> reached_;   ///< end of a step that is not accepted yet [s]
    std::int64_t complete_step_ = 0;  ///< of the newest checkpoint to which the client has a fluid
    bool is_asked_ = false;           ///< the client asks for checkpoints
    std::int64_t kept_ = -1;          ///< step of the last checkpoint
    double bytes_before_ = 0;         ///< that sessions with clients that were lost have moved
    double bytes_ = 0;                ///< of this session until the last step
    bool is_in_step_ = false;         ///< the particles move: theirs is the state of no time
};

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
/// How a coupled run comes to its first step: from a bed, from a checkpoint, or back to one with a client that returns.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "app/CoupledRun.hpp"
#include "app/Run.hpp"
#include "app/Terms.hpp"
#include "core/Error.hpp"
#include "engine/AddedMassCheck.hpp"
#include "engine/BedMonitors.hpp"
#include "engine/CellSizeCheck.hpp"
#include "engine/Settling.hpp"
#include "engine/StartChecks.hpp"
#include "engine/WallStartCheck.hpp"
#include "engine/WallStepCheck.hpp"

namespace gimdem::app
{

namespace
{

/// Puts the settled bed into the system: from the file where it was settled before, else by settling now.
void settle_or_load(Case const& settings, exec::Execution execution, WallGeometry const& walls, PolyMesh const& mesh,
                    DemSystem& system, output::Progress& progress, RunObserver& observer)
{
    system.prepare();
    if (!settings.settle || settings.settle->duration <= 0) return;
    auto const file = settled_bed_file(settings, walls, mesh);
    if (!std::filesystem::exists(file))
    {
        double const time = settle(settings, execution, system,
                                   [&](double at, double energy)
                                   {
                                       progress.show(output::SettlingSample{at, settings.settle->duration, energy,
                                                                            settings.settle->kinetic_energy});
                                       observer.phase("settling the bed", at, settings.settle->duration);
                                       return !interrupted();
                                   });
        progress.finish();
        write_state(file, "settled bed", system, time);
    }
    // Always by way of the file, so that a bed just settled and one kept give the same run to the bit.
    read_state(file, "settled bed", system);
}

}  // namespace

void CoupledRun::start(std::optional<std::filesystem::path> const& restart)
{
    std::string const note = note_on_small_cells(mesh_, reach_of(settings_, std::as_const(system_).particles()));
    if (!note.empty()) events_.warn("small_cells", note);
    engine_.set_inlets(inlets_);
    if (restart)
    {
        system_.prepare();
        load(*restart);
        require_time_left(*restart, at_, settings_.run.until);
        if (client_.resume && client_.resume->step != at_.step)
            throw UserError(
                fmt::format("the client goes on from the checkpoint of step {}, the particles from that of "
                            "step {} (they must be one pair); restart both from the same one",
                            client_.resume->step, at_.step));
    }
    else
    {
        settle();
        engine_.map_initial_state();
    }
    warn_of_added_mass();
    accept_mesh();
}

void CoupledRun::warn_of_added_mass()
{
    if (schedule_ == coupling::Schedule::iterated || !settings_.fluid_forces.pressure_gradient) return;
    double lightest = std::numeric_limits<double>::infinity();
    for (std::int32_t const material : std::as_const(system_).particles().material.host())
        lightest = std::min(lightest, settings_.materials[static_cast<std::size_t>(material)].density);
    auto const void_fraction = engine_.fields().void_fraction;
    std::string const note =
        note_on_added_mass(client_.fluid.density, lightest, {void_fraction.data(), void_fraction.size()});
    if (!note.empty()) events_.warn("added_mass", note);
}

void CoupledRun::go_on(coupling::ClientInfo const& client)
{
    require_same(client);
    auto const file = find_checkpoint(folder_, client.resume->step);
    if (!file)
        throw UserError(
            fmt::format("there is no checkpoint of step {} in {} (the client goes on from it); start it "
                        "from a newer state",
                        client.resume->step, (folder_ / "checkpoints").string()));
    if (mesh_hash(server_.receive_mesh()) != engine_.mapped().mesh)
    {
        server_.reject_mesh("it is not the mesh of before");
        throw UserError("the client has come back with another mesh (the particles go on on that of before)");
    }
    bytes_before_ += bytes_;
    engine_.forget_particles();
    reached_.reset();
    load(*file);
    log_.rewind(at_.time);
    coupling_log_.rewind(at_.time);
    accept_mesh();
}

void CoupledRun::settle()
{
    check_particles_against_walls(system_.particles(), walls_);
    check_wall_steps(settings_, walls_, mesh_, smallest_radius(settings_, std::as_const(system_).particles()));
    settle_or_load(settings_, execution_, walls_, mesh_, system_, log_.progress(), observer_);
    Vec3 const up = upward(settings_);
    log_.summary().add("settled_height", bed_height(system_.particles(), mesh_, up), "m");
    log_.summary().add("settled_height_2z", 2 * centre_of_mass_height(system_.particles(), mesh_, up), "m");
}

void CoupledRun::load(std::filesystem::path const& file)
{
    MappedState mapped;
    start_ = at_ = read_checkpoint(file, settings_, inlets_, system_, engine_.weight_reuse(), &mapped);
    kept_ = at_.step;
    is_in_step_ = false;
    engine_.resume(mapped);
    events_.say("restarted", fmt::format("{} particles from {:.6g} s", system_.particles().count(), at_.time),
                {{"checkpoint", file.string()}, {"time_s", at_.time}});
}

void CoupledRun::accept_mesh()
{
    server_.accept_mesh(engine_.fields(), {}, cells_to_send(at_.time));
    if (!server_.shared_memory_note().empty()) events_.warn("plain_frames", server_.shared_memory_note());
    events_.note("mesh_accepted", "the mesh is accepted",
                 {{"cells", static_cast<double>(mesh_.cell_count())},
                  {"particles", static_cast<double>(system_.particles().count())}});
}

void CoupledRun::require_same(coupling::ClientInfo const& client) const
{
    bool const same = client.fluid.density == client_.fluid.density &&
                      client.fluid.viscosity == client_.fluid.viscosity && schedule_of(settings_, client) == schedule_;
    if (same) return;
    throw UserError(
        "the client has come back with another fluid or schedule (the run goes on with those of before); start it as "
        "before, or run the case again");
}

}  // namespace gimdem::app

// SPDX-License-Identifier: BSD-3-Clause
/// The particles and one time step of their motion.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contact/ParticleContacts.hpp"
#include "core/Case.hpp"
#include "exec/Execution.hpp"
#include "forces/FluidForces.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "search/NeighborList.hpp"
#include "walls/WallContacts.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem
{

/// Everything that a DEM step needs of the fluid; owned by the coupled engine.
struct FluidOnParticles
{
    FluidForces& forces;
    PolyMesh const& mesh;
    exec::Buffer<std::int32_t> const& cell_of;
    exec::Buffer<double> const& void_fraction;
};

/// Particles that left, by cause.
struct Removed
{
    std::int64_t count = 0;
    double mass = 0;  ///< [kg]
};
using RemovedByCause = std::map<std::string, Removed>;

/// How the cause of those begins that left where there is no way out.
inline char const* const through_wall = "through the wall ";

class DeviceDem;
struct DemMemory;

/// Where the execution names a device, the state lives there. The host's copy is brought up to date when it is asked
/// for, and goes back before the next step where it could have been changed: prefer the const accessors.
class DemSystem
{
public:
    DemSystem(Case const& settings, exec::Execution execution, Materials const& materials, WallGeometry const& walls,
              ParticleState particles);
    ~DemSystem();

    /// Forces at the present positions, springs unmoved: call once before the first step and after a restart.
    void prepare();

    /// Takes a new fluid state (null: none) for the steps to come and clears the impulses.
    void begin_coupling_step(FluidOnParticles const* fluid);

    /// Sum of the steady part of the fluid's force over all particles [N].
    Vec3 steady_fluid_force() const;

    /// Sets the impulses to what the present drag would give in one second.
    void take_impulses_of_one_second();

    /// One step of velocity Verlet, theory.md (D.13). dt [s].
    void step(double dt);

    /// Whether prescribed wall motion goes on with the steps; until told so walls stand where they are at time 0.
    void let_walls_move(bool move) { walls_move_ = move; }

    /// Adds particles at the end and gives them ids that none had before. Forces are those at the present positions
    /// afterwards, as after prepare().
    void insert(ParticleState const& more);

    /// Removes the particles i with cause[i] >= 0 and counts them under causes[cause[i]]. Forces are those at the
    /// present positions afterwards. Returns how many were removed.
    std::int64_t remove(std::span<std::int32_t const> cause, std::vector<std::string> const& causes);

    /// Builds the neighbour list anew and computes the forces at the present positions.
    void rebuild();

    /// After particles(), and of neighbors() and walls().pairs() the places where the list was built, the rows and the
    /// springs were replaced by those of a state: builds the same list, and goes on from it as the state would have,
    /// to the bit. `wall_force`: what total_force() of the walls was [N].
    void resume(Vec3 const& wall_force);

    /// Keeps all that the steps to come change.
    void remember(DemMemory& memory);
    /// Puts it back, to the bit.
    void go_back(DemMemory const& memory);

    RemovedByCause& removed() { return removed_; }
    RemovedByCause const& removed() const { return removed_; }
    std::int64_t next_id() const { return next_id_; }
    void set_next_id(std::int64_t id) { next_id_ = id; }

    ParticleState& particles() { return to_change(), particles_; }
    ParticleState const& particles() const { return to_look(), particles_; }
    NeighborList& neighbors() { return to_change(), neighbors_; }
    NeighborList const& neighbors() const { return to_look(), neighbors_; }
    WallContacts& walls() { return to_change(), wall_contacts_; }
    WallContacts const& walls() const { return to_look(), wall_contacts_; }
    /// Of the coupling step so far; empty without a fluid.
    exec::Buffer<Impulse> const& impulses() const { return to_look(), impulses_; }
    /// Time integral of the walls' force on all particles over the coupling step so far [N s].
    Vec3 wall_impulse() const;
    std::int64_t rebuilds() const;

    /// The device that the particles are on, up to date; null where they are on the host.
    DeviceDem* device();

    /// Particles change places when the neighbour list is rebuilt, and numbers when some are added or removed:
    /// `listener` is told order, with the particle now at i having been at order[i]; order[i] beyond the old count is a
    /// new particle. For whoever else holds data per particle.
    void set_permutation_listener(std::function<void(std::span<std::int32_t const>)> listener)
    {
        on_permutation_ = std::move(listener);
    }

private:
    void half_kick(double h);
    void drift(double dt);
    void update_neighbors();
    std::span<std::int32_t const> build_lists();
    void sum_contact_forces(double dt);
    void update_fluid_loads();
    void to_look() const;
    void to_change();
    void refuse_if(bool diverged);

    exec::Execution execution_;
    Constant3 gravity_;
    ParticleState particles_;
    NeighborSearch search_;
    NeighborList neighbors_;
    ParticleContacts particle_contacts_;
    WallContacts wall_contacts_;
    exec::Room room_;  ///< for build_lists()
    bool walls_move_ = false;
    FluidOnParticles const* fluid_ = nullptr;
    exec::Buffer<FluidLoad> loads_;
    exec::Buffer<Impulse> impulses_;
    Vec3 wall_impulse_ = Vec3::Zero();
    std::function<void(std::span<std::int32_t const>)> on_permutation_;
    std::int64_t rebuilds_ = 0;
    std::int64_t next_id_ = 0;
    RemovedByCause removed_;
    std::unique_ptr<DeviceDem> device_;  ///< null: all is on the host
    bool device_is_old_ = true;          ///< the host has what the device has not
    mutable bool host_is_old_ = false;   ///< the other way round
};

/// Particles that there were and that are neither here nor gone through an outlet: 0, or something is wrong.
std::int64_t lost_particles(DemSystem const& system);

/// True for particles that share one radius and one mass.
bool have_one_size(ParticleState const& particles);

/// Smallest radius of a set of particles [m]; 0 for none.
double smallest_radius(ParticleState const& particles);
double largest_radius(ParticleState const& particles);

/// The same of the particles that there are at the start and all that inlets bring [m].
double smallest_radius(Case const& settings, ParticleState const& particles);
double largest_radius(Case const& settings, ParticleState const& particles);

/// How far a particle's centre can be from a wall that it may soon touch [m].
double reach_of(Case const& settings, ParticleState const& particles);

}  // namespace gimdem

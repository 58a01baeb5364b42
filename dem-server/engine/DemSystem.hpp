// SPDX-License-Identifier: BSD-3-Clause
/// The particles and one time step of their motion.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>

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

class DemSystem
{
public:
    DemSystem(Case const& settings, exec::Execution execution, Materials const& materials, WallGeometry const& walls,
              ParticleState particles);

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

    ParticleState& particles() { return particles_; }
    ParticleState const& particles() const { return particles_; }
    NeighborList& neighbors() { return neighbors_; }
    NeighborList const& neighbors() const { return neighbors_; }
    WallContacts& walls() { return wall_contacts_; }
    WallContacts const& walls() const { return wall_contacts_; }
    exec::Buffer<Impulse> const& impulses() const { return impulses_; }
    /// Time integral of the walls' force on all particles over the coupling step so far [N s].
    Vec3 wall_impulse() const { return wall_impulse_; }
    std::int64_t rebuilds() const { return rebuilds_; }

    /// Particles change places when the neighbour list is rebuilt: `listener` is told order, with the particle now at i
    /// having been at order[i]. For whoever else holds data per particle.
    void set_permutation_listener(std::function<void(std::span<std::int32_t const>)> listener)
    {
        on_permutation_ = std::move(listener);
    }

private:
    void half_kick(double h);
    void drift(double dt);
    void update_neighbors();
    void sum_contact_forces(double dt);
    void update_fluid_loads();

    exec::Execution execution_;
    Constant3 gravity_;
    ParticleState particles_;
    NeighborSearch search_;
    NeighborList neighbors_;
    ParticleContacts particle_contacts_;
    WallContacts wall_contacts_;
    bool walls_move_ = false;
    FluidOnParticles const* fluid_ = nullptr;
    exec::Buffer<FluidLoad> loads_;
    exec::Buffer<Impulse> impulses_;
    Vec3 wall_impulse_ = Vec3::Zero();
    std::function<void(std::span<std::int32_t const>)> on_permutation_;
    std::int64_t rebuilds_ = 0;
};

/// True for particles that share one radius and one mass.
bool have_one_size(ParticleState const& particles);

/// Smallest radius of a set of particles [m]; 0 for none.
double smallest_radius(ParticleState const& particles);
double largest_radius(ParticleState const& particles);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// One coupling step of the particle side: fluid in, particles moved, solid out.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/Case.hpp"
#include "engine/DemSystem.hpp"
#include "engine/FluidCoverage.hpp"
#include "engine/MappedState.hpp"
#include "engine/device/DeviceDem.hpp"
#include "gimdem/coupling/Types.hpp"
#include "mapping/Mapper.hpp"
#include "particles/Inlet.hpp"

namespace gimdem
{

/// What a coupling step did, for logs and checks. Forces are means over the step, sums over all particles.
struct StepReport
{
    std::int64_t dem_steps = 0;
    bool fluid_was_wanted = false;  ///< cells were read that had not been asked for, and the whole fluid was fetched
    std::int64_t removed = 0;       ///< particles that left the mesh in this step; mapped a last time, then removed
    double momentum_imbalance = 0;  ///< |sum S V + sum F_d| / sum |F_d|, theory.md (C.3) [1]
    double volume_imbalance = 0;    ///< |sum solid V - sum V_p| / sum V_p [1]
    std::int64_t cell_clips = 0;    ///< cells whose void fraction was raised to the minimum
    double void_fraction_min = 1, void_fraction_max = 1;
    Constant3 drag_force{0, 0, 0};      ///< on the particles [N]
    Constant3 pressure_force{0, 0, 0};  ///< on the particles [N]
    Constant3 wall_force{0, 0, 0};      ///< of the walls on the particles [N]
    coupling::Timings timings;          ///< compute: DEM, mapping
};

struct StepMemory;

class CoupledEngine
{
public:
    /// Takes particles that are at rest in the mesh. Throws UserError for a particle outside the mesh.
    CoupledEngine(Case const& settings, exec::Execution execution, PolyMesh const& mesh, WallGeometry const& walls,
                  coupling::FluidProperties const& fluid, DemSystem& system);
    ~CoupledEngine();

    /// The solid at t = 0, with the drag of particles in a fluid at rest.
    StepReport map_initial_state();

    /// Moves the particles t -> t + dt in the fluid of time t and maps them, theory.md (C.1)-(C.7). Takes the least
    /// whole number of equal DEM steps that are no longer than [dem] time_step.
    /// whole_fluid: where fluid has only the cells of step_cells(), gives it with all of them.
    StepReport advance(coupling::Step const& step, coupling::FluidFields fluid,
                       std::function<coupling::FluidFields()> const& whole_fluid = {});

    /// Keeps the state between two steps, for go_back().
    void remember();
    /// Puts it back, to the bit, with inlets and counts; fields() stay those of the step that is given up. @pre
    /// remember()
    void go_back();

    /// The solid of the last step; spans live until the next one.
    coupling::SolidFields fields() const;

    /// Which cells of the solid are to travel, and of the fluid of the next step. can_ask: advance() will be given a
    /// whole_fluid that works.
    coupling::StepCells step_cells(bool can_ask);
    /// Cells whose pressure and gradients somebody else reads, too.
    void monitor(std::span<std::int32_t const> cells) { coverage_.monitor(cells); }

    /// Particles that come during the run; `inlets` outlives the engine.
    void set_inlets(std::vector<Inlet>& inlets) { inlets_ = &inlets; }

    /// For checkpoints: what the last step left on the mesh.
    MappedState mapped() const;
    /// Before another state is put into the system: what is known of the particles so far is of no use.
    void forget_particles();
    /// Goes on with what a checkpoint had on the mesh, if that was this mesh; else maps the particles as at t = 0.
    void resume(MappedState const& mapped);

    /// For checkpoints; null unless weights are reused.
    WeightReuse* weight_reuse() { return mapper_.reuse(); }

    std::int64_t particle_clips() const;
    exec::Buffer<double> const& void_fraction() const { return void_fraction_; }

private:
    void load_fluid(coupling::FluidFields const& fluid);
    void locate();
    void sum_into_cells();
    ImpulseSums impulse_sums() const;
    void map_particles(double dt, std::function<coupling::FluidFields()> const& fluid, StepReport& report);
    void compute_void_fraction(StepReport& report);
    void compute_momentum_exchange(double dt, coupling::FluidFields const& fluid);
    void mark_cells();
    void mark_resumed_cells();
    void look_ahead();
    std::span<std::int32_t const> cells_with_particles();
    void check_balance(double dt, StepReport& report) const;
    void insert_due(double time);
    std::int64_t remove_leavers();

    Case const& settings_;
    exec::Execution execution_;
    PolyMesh const& mesh_;
    std::string mesh_hash_;
    DemSystem& system_;
    FluidForces forces_;
    Mapper mapper_;
    FluidOnParticles on_particles_;
    exec::Buffer<std::uint8_t> wall_faces_;
    std::vector<Inlet>* inlets_ = nullptr;
    CellSums sums_;
    std::unique_ptr<StepMemory> memory_;
    std::int64_t clips_given_up_ = 0;  ///< counted in steps that were repeated
    exec::Buffer<double> void_fraction_, momentum_source_, drag_coefficient_, drag_momentum_;
    exec::Buffer<std::uint8_t> has_solid_, has_drag_;  ///< flags of the cells
    exec::Buffer<std::uint8_t> occupied_;              ///< likewise, from a device
    std::vector<std::int32_t> occupied_cells_;
    FluidCoverage coverage_;
};

}  // namespace gimdem

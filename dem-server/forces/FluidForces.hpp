// SPDX-License-Identifier: BSD-3-Clause
/// What the fluid does to the particles: drag and pressure gradient, theory.md (D.15)-(D.18).
#pragma once

#include <cstdint>

#include "core/Case.hpp"
#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "gimdem/coupling/Types.hpp"
#include "mesh/PolyMesh.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// The fluid's force on one particle, linear in its velocity within a DEM step: F = k (v_f - v_p) + steady.
struct FluidLoad
{
    Quad fluid_velocity;  ///< v_f at the particle [m/s], w: k [kg/s]
    Quad steady;          ///< -V_p grad p [N]
};

/// The fluid of a coupling step and the law that turns it into forces.
class FluidForces
{
public:
    FluidForces(exec::Execution execution, FluidForceSettings const& settings, double void_fraction_minimum,
                coupling::FluidProperties const& fluid)
        : execution_(execution), settings_(settings), void_fraction_minimum_(void_fraction_minimum), fluid_(fluid)
    {
    }

    /// Copies the fluid at t; it holds until the next call.
    void load(coupling::FluidFields const& fields, std::int32_t cell_count);

    /// Sets each particle's load. `cell_of` and `void_fraction` are those of the last mapping: shape=(n_particles,) and
    /// (n_cells,).
    void apply(ParticleState& particles, PolyMesh const& mesh, exec::Buffer<std::int32_t> const& cell_of,
               exec::Buffer<double> const& void_fraction, exec::Buffer<FluidLoad>& loads);

    /// How often the void fraction at a particle (Eq. 25) was clipped into [minimum, 1] so far.
    std::int64_t clipped() const { return clipped_; }

private:
    exec::Execution execution_;
    FluidForceSettings settings_;
    double void_fraction_minimum_;
    coupling::FluidProperties fluid_;
    exec::Buffer<Quad> velocity_;             ///< per cell [m/s]
    exec::Buffer<Quad> pressure_gradient_;    ///< per cell [Pa/m]
    exec::Buffer<Quad> void_gradient_;        ///< per cell [1/m]
    exec::Buffer<double> velocity_gradient_;  ///< per cell, 9 numbers [1/s]
    exec::Buffer<std::uint8_t> was_clipped_;
    std::int64_t clipped_ = 0;
};

}  // namespace gimdem

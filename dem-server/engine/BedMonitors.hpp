// SPDX-License-Identifier: BSD-3-Clause
/// Numbers that tell how a bed is doing; each definition stands beside its function.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/Case.hpp"
#include "engine/PlaneSection.hpp"
#include "gimdem/coupling/Types.hpp"
#include "mesh/PolyMesh.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// Unit vector against gravity; z where there is none.
Vec3 upward(Case const& settings);

/// Height of the bed's surface above the lowest point of the mesh [m]: the plan is cut into square columns four times
/// the largest diameter wide (at least one a side), each column's surface is the 99th percentile of the particles' tops
/// (centre + radius) in it, and the bed height is the mean over the columns that hold a particle.
double bed_height(ParticleState const& particles, PolyMesh const& mesh, Vec3 const& up);

/// Height of the centre of mass above the lowest point of the mesh [m].
double centre_of_mass_height(ParticleState const& particles, PolyMesh const& mesh, Vec3 const& up);

/// Momentum of all particles [kg m/s].
Vec3 momentum(ParticleState const& particles);

/// Mass of all particles [kg].
double total_mass(ParticleState const& particles);

/// Largest speed [m/s].
double fastest(ParticleState const& particles);

/// Area-weighted mean pressure over a patch [Pa], each face's value carried from its cell's centroid by the gradient.
double patch_pressure(PolyMesh const& mesh, coupling::Patch const& patch, coupling::FluidFields const& fluid);

/// Area of a patch [m^2].
double patch_area(PolyMesh const& mesh, coupling::Patch const& patch);

}  // namespace gimdem

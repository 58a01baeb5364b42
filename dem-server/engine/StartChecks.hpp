// SPDX-License-Identifier: BSD-3-Clause
/// What must be true before the first step.
#pragma once

#include "core/Case.hpp"
#include "exec/Execution.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "search/Domain.hpp"

namespace gimdem
{

/// Largest share of the Rayleigh time that a DEM step may take; 10 to 20 % is the common advice.
inline constexpr double rayleigh_share_limit = 0.2;

/// Shortest Rayleigh time of all particles [s], theory.md (D.14); infinity for none.
double shortest_rayleigh_time(Materials const& materials, ParticleState const& particles);

/// Largest share of the shortest contact that a DEM step may take with the linear law; 1/50 to 1/20 is the common
/// advice.
inline constexpr double contact_share_limit = 0.1;

/// Shortest contact of any two of these particles and those of inlets, or of one and a wall, with the linear law [s],
/// theory.md (D.31); infinity for none.
double shortest_linear_contact(Case const& settings, Materials const& materials, ParticleState const& particles);

/// Throws UserError where [dem] time_step is above 20 % of the shortest Rayleigh time or, with the linear contact law,
/// above 10 % of the shortest contact: tells both and the largest step allowed.
void check_time_step(Case const& settings, Materials const& materials, ParticleState const& particles);

/// Throws UserError where two particles overlap by more than 1 % of the smaller diameter, across a periodic border too:
/// names both and the overlap.
void check_overlaps(exec::Execution execution, ParticleState const& particles, Domain const& domain = {});

/// Throws UserError for a coupled run with a periodic domain: walls and mapping know the client's mesh only, which has
/// no other side to come in on.
void refuse_periodic_coupled_run(Case const& settings);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Particles that come during the run, at a rate of mass.
#pragma once

#include <cstdint>
#include <vector>

#include "core/Case.hpp"
#include "particles/Materials.hpp"
#include "particles/SizeDistribution.hpp"
#include "particles/SphereSeed.hpp"
#include "search/Domain.hpp"

namespace gimdem
{

/// All of an inlet that changes: what a checkpoint keeps.
struct InletState
{
    std::uint64_t random = 0;   ///< state of the random numbers
    std::int64_t lots = 0;      ///< how often it was due so far
    std::int64_t inserted = 0;  ///< particles
    double mass = 0;            ///< of them [kg]
    double next_diameter = 0;   ///< of the particle that comes next [m]
};

/// One [[inlets]]. Every `interval` it is due; then it inserts particles one by one while the mass that it owes is at
/// least half that of the next one, theory.md (D.66). One that finds no place without overlap has to wait for the next
/// lot; nothing is forgotten: what is owed stays owed.
class Inlet
{
public:
    Inlet(InletSettings const& settings, Materials const& materials, Domain const& domain = {});

    /// True where particles are to come at `time` [s].
    bool is_due(double time) const;

    /// The particles that come at `time`, none of which overlaps one that is there, across a periodic border too.
    std::vector<SphereSeed> take(double time, ParticleState const& present);

    int material() const { return material_; }
    double density() const { return density_; }                       ///< [kg/m^3]
    double smallest_radius() const { return sizes_.smallest() / 2; }  ///< [m]
    double largest_radius() const { return sizes_.largest() / 2; }    ///< [m]
    double owed(double time) const;                                   ///< mass that should have come and has not [kg]

    InletState const& state() const { return state_; }
    void restore(InletState const& state) { state_ = state; }

    /// Tries of one sphere before it has to wait.
    static constexpr int most_attempts = 200;

private:
    double next_mass() const { return density_ * sphere_volume(state_.next_diameter / 2); }
    Vec3 random_place(double radius, RandomStream& random) const;

    template <class Visit>
    void visit_images(Vec3 const& x, Visit&& visit) const;

    InletSettings settings_;
    Domain domain_;
    int material_;
    double density_;
    SizeDistribution sizes_;
    Vec3 low_, high_;                                    ///< box around the region [m]
    Vec3 across_ = Vec3::Zero(), along_ = Vec3::Zero();  ///< unit vectors in the disc
    InletState state_;
};

}  // namespace gimdem

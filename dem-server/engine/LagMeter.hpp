// SPDX-License-Identifier: BSD-3-Clause
/// What it costs, or would cost, that an overlapped fluid step sees the particles of one step before, theory.md
/// (C.11).
#pragma once

#include <vector>

#include "gimdem/coupling/Types.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// Relative changes of what the particles are to the fluid over one coupling step, root mean squares over the volume.
struct LagError
{
    double force = 0;           ///< of the force per volume at the same velocity of the fluid, (C.11) [1]
    double solid_fraction = 0;  ///< of 1 - void fraction, (C.11) [1]
};

class LagMeter
{
public:
    explicit LagMeter(PolyMesh const& mesh) : mesh_(mesh) {}

    /// The solid of a step, with the fluid's velocity at its beginning (empty: at rest), against the solid of the step
    /// before; 0 for the first.
    LagError measure(coupling::SolidFields const& solid, coupling::Span<double const> velocity);

private:
    double force_change(coupling::SolidFields const& solid, coupling::Span<double const> velocity) const;
    double fraction_change(coupling::Span<double const> void_fraction) const;

    PolyMesh const& mesh_;
    std::vector<double> void_fraction_, coefficient_, momentum_;  ///< of the step before
};

}  // namespace gimdem

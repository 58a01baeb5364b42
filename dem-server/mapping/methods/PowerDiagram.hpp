// SPDX-License-Identifier: BSD-3-Clause
/// `power-diagram`: cells are the regions where their potentials are least, and a ball blurs the border between two of
/// them as it would a plane, theory.md (G.34)-(G.39).
#pragma once

#include "mapping/CellPotentials.hpp"
#include "mapping/methods/ReachingMethod.hpp"

namespace gimdem
{

class PowerDiagram : public ReachingMethod
{
public:
    PowerDiagram(exec::Execution const& execution, PolyMesh const& mesh);

    exec::Buffer<CellPotential> const& potentials() const { return potentials_; }
    void compute_weights(WeightTask const& task) override;

private:
    CellRows find_candidates(double largest) const override;

    PolyMesh const& mesh_;
    exec::Buffer<CellPotential> potentials_;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// `power-diagram`: cells are the regions where their potentials are least, and a ball blurs the border between two of
/// them as it would a plane, theory.md (G.34)-(G.39).
#pragma once

#include "mapping/CellPotentials.hpp"
#include "mapping/Method.hpp"
#include "mesh/NearbyCells.hpp"

namespace gimdem
{

class PowerDiagram : public Method
{
public:
    PowerDiagram(exec::Execution const& execution, PolyMesh const& mesh);

    CellRows const& candidates() const override { return candidates_; }
    exec::Buffer<CellPotential> const& potentials() const { return potentials_; }
    bool prepare(ParticleState const& particles) override;
    void compute_weights(WeightTask const& task) override;

private:
    void find_candidates();

    exec::Execution execution_;
    PolyMesh const& mesh_;
    exec::Buffer<CellPotential> potentials_;
    exec::Buffer<CellBox> boxes_;
    double largest_ = 0;  ///< radius that the candidates are made for [m]
    CellRows candidates_;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// `diffusion`: the particle-centre method, whose fields are then smoothed by the heat equation on the mesh, theory.md
/// (G.31)-(G.33). Nothing passes through the boundary.
#pragma once

#include "mapping/methods/ParticleCentre.hpp"

namespace gimdem
{

class Diffusion : public ParticleCentre
{
public:
    /// bandwidth: b in diameters of the largest particle.
    Diffusion(exec::Execution const& execution, PolyMesh const& mesh, double bandwidth);

    bool prepare(ParticleState const& particles) override;
    void spread(CellSums& sums) override;

private:
    static constexpr int step_count = 4;
    static constexpr int most_iterations = 1000;

    void spread(exec::Buffer<double>& values);
    void apply(exec::Buffer<double> const& density, exec::Buffer<double>& result) const;
    void solve(exec::Buffer<double> const& values, exec::Buffer<double>& density);

    exec::Execution execution_;
    PolyMesh const& mesh_;
    double bandwidth_;
    double largest_diameter_ = 0;        ///< [m]
    exec::Buffer<double> conductance_;   ///< of each internal face [m]
    exec::Buffer<double> per_diagonal_;  ///< 1 / diagonal of the matrix [1/m^3]
    double step_ = 0;                    ///< of one implicit step [m^2]
    exec::Buffer<double> residual_, way_, image_, scaled_, values_, density_;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// `gim`, the Gaussian Integral Method with Eq. 27, and `gim-fixed`, the same with one coefficient for all pairs,
/// theory.md (G.4)-(G.11): from tables where the scene has few radii and cell sizes, from curves of the
/// cells where it has few radii.
#pragma once

#include "mapping/CellCurves.hpp"
#include "mapping/GaussianTable.hpp"
#include "mapping/Method.hpp"
#include "mapping/WeightKernel.hpp"

namespace gimdem
{

class GaussianMethod : public Method
{
public:
    /// fixed_coefficient: phi of all pairs; 0: that of Eq. 27.
    explicit GaussianMethod(PolyMesh const& mesh, double fixed_coefficient = 0);

    CellRows const& candidates() const override { return layers_; }
    void compute_weights(WeightTask const& task) override;

    // What a device needs to do the same.
    GaussianTables& tables() { return tables_; }
    exec::Buffer<CellSize> const& cell_sizes() const { return cell_sizes_; }
    double fixed_coefficient() const { return fixed_coefficient_; }

private:
    PolyMesh const& mesh_;
    CellLayers layers_;
    GaussianTables tables_;
    CellCurves curves_;
    exec::Buffer<CellSize> cell_sizes_;
    double fixed_coefficient_;
};

}  // namespace gimdem

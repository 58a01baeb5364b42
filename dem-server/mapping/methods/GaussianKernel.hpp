// SPDX-License-Identifier: BSD-3-Clause
/// `kernel`: a particle is a single Gaussian, taken at the centres of the cells, theory.md (G.29). At a wall the
/// weights of the cells that there are sum to one all the same.
#pragma once

#include <cmath>

#include "mapping/methods/ReachingMethod.hpp"

namespace gimdem
{

class GaussianKernel : public ReachingMethod
{
public:
    /// bandwidth: b in diameters of the particle. Beyond 3 b is nothing.
    GaussianKernel(exec::Execution const& execution, PolyMesh const& mesh, double bandwidth)
        : ReachingMethod(execution, mesh, 6 * bandwidth), mesh_(mesh), bandwidth_(bandwidth)
    {
    }

    double radii() const { return 2 * bandwidth_; }  ///< b in radii of the particle

    void compute_weights(WeightTask const& task) override { fill_rows(task, Law{mesh_.view().cell, radii()}); }

private:
    struct Law
    {
        Quad const* cell;
        double radii;  ///< b in radii

        GIMDEM_HD void operator()(Quad const& particle, std::int32_t const* cells, int count, double* w) const
        {
            double const b = radii * particle.w;
            for (int k = 0; k < count; ++k)
            {
                Quad const& at = cell[cells[k]];
                double const x = (at.xyz() - particle.xyz()).norm() / b;
                w[k] = x < 3 ? at.w * std::exp(-x * x) : 0;
            }
        }
    };

    PolyMesh const& mesh_;
    double bandwidth_;
};

}  // namespace gimdem

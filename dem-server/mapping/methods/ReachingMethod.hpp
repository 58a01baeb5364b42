// SPDX-License-Identifier: BSD-3-Clause
/// A method whose candidates are all cells within some radii of a particle's own cell.
#pragma once

#include <algorithm>

#include "exec/Reduce.hpp"
#include "mapping/Method.hpp"
#include "mesh/NearbyCells.hpp"

namespace gimdem
{

class ReachingMethod : public Method
{
public:
    /// `radii`: how far a particle reaches, in units of its radius.
    ReachingMethod(exec::Execution const& execution, PolyMesh const& mesh, double radii)
        : execution_(execution), boxes_(cell_boxes(mesh)), radii_(radii)
    {
        // Before there are particles the rows are those of points.
        candidates_ = nearby_cells(boxes_, 0);
    }

    CellRows const& candidates() const override { return candidates_; }

    bool prepare(ParticleState const& particles) override
    {
        Quad const* const position = particles.position.view().data;
        double const largest =
            exec::maximum(execution_, particles.count(), 0.0, [=](std::int64_t p) { return position[p].w; });
        if (largest <= largest_) return false;
        largest_ = largest;
        candidates_ = find_candidates(largest);
        return true;
    }

protected:
    /// Cells that particles of a radius up to `largest` [m] may give to.
    virtual CellRows find_candidates(double largest) const
    {
        // A thousandth more: a particle may be a rounding outside of its cell.
        return within(1.001 * radii_ * largest);
    }
    CellRows within(double reach) const { return nearby_cells(boxes_, reach); }  ///< reach in [m]
    exec::Execution const& execution() const { return execution_; }

private:
    exec::Execution execution_;
    exec::Buffer<CellBox> boxes_;
    double radii_;
    double largest_ = 0;  ///< radius that the candidates are made for [m]
    CellRows candidates_;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// `exact`: each cell takes the volume that it shares with the particle, theory.md (G.20)-(G.25). What is beyond the
/// mesh is taken by the cells inside in proportion.
#pragma once

#include "mapping/methods/ReachingMethod.hpp"
#include "mapping/overlap/CellOverlap.hpp"

namespace gimdem
{

class ExactOverlap : public ReachingMethod
{
public:
    ExactOverlap(exec::Execution const& execution, PolyMesh const& mesh)
        : ReachingMethod(execution, mesh, 1), facets_(mesh)
    {
    }

    overlap::CellFacets const& facets() const { return facets_; }

    void compute_weights(WeightTask const& task) override { fill_rows(task, Law{facets_.view()}); }

private:
    struct Law
    {
        overlap::CellFacetsView facets;

        GIMDEM_HD void operator()(Quad const& particle, std::int32_t const* cells, int count, double* w) const
        {
            overlap::overlap_with_row({facets, particle.xyz(), particle.w}, cells, count, w);
        }
    };

    overlap::CellFacets facets_;
};

}  // namespace gimdem

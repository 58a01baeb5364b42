// SPDX-License-Identifier: BSD-3-Clause
/// `pcm`, the particle-centre method: the cell that holds the centre takes all, theory.md (G.26).
#pragma once

#include "mapping/Method.hpp"

namespace gimdem
{

/// For each cell itself alone.
inline CellRows own_cells(std::int32_t count)
{
    CellRows rows;
    rows.offsets.resize(count + 1);
    rows.cells.resize(count);
    for (std::int32_t c = 0; c < count; ++c)
        rows.offsets[c] = rows.cells[c] = c;
    rows.offsets[count] = count;
    return rows;
}

class ParticleCentre : public Method
{
public:
    explicit ParticleCentre(PolyMesh const& mesh) : candidates_(own_cells(mesh.cell_count())) {}

    CellRows const& candidates() const override { return candidates_; }
    void compute_weights(WeightTask const& task) override { fill_rows(task, Law{}); }

private:
    struct Law
    {
        GIMDEM_HD void operator()(Quad const&, std::int32_t const*, int, double* w) const { w[0] = 1; }
    };

    CellRows candidates_;
};

}  // namespace gimdem

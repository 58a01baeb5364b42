// SPDX-License-Identifier: BSD-3-Clause
/// What a way of mapping particles onto cells has to say; all else is the Mapper's and the same for all of them.
///
/// A method is conservative (weights of a particle sum to one) whatever it computes: its rows are normalised here. It
/// works for one more method to fill a row, in a file of methods/, and to be listed in methods/MakeMethod.cpp.
#pragma once

#include <cstdint>
#include <memory>

#include "core/Case.hpp"
#include "exec/Buffer.hpp"
#include "exec/ForEach.hpp"
#include "exec/Selection.hpp"
#include "mapping/Share.hpp"
#include "mesh/PolyMesh.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// Rows of weights, one for each particle: the particles of a cell have consecutive rows as long as its candidates.
struct WeightRows
{
    std::int32_t const* layer_offsets;  ///< candidates of cell c are layer_cells[layer_offsets[c] ...), itself first
    std::int32_t const* layer_cells;
    std::int32_t const* particle_offsets;  ///< particles of cell c are members[particle_offsets[c] ...)
    std::int32_t const* members;
    std::int64_t const* first;  ///< place of the first weight of cell c

    GIMDEM_HD int length(std::int32_t c) const { return layer_offsets[c + 1] - layer_offsets[c]; }
};

/// Rows that are to be filled, and with whose weights.
struct WeightTask
{
    exec::Execution execution;
    ParticleState const& particles;
    exec::Buffer<std::int32_t> const& occupied;  ///< cells that hold particles
    WeightRows rows;
    double* weights;
};

class Method
{
public:
    virtual ~Method() = default;

    /// Cells that the particles of a cell may give to.
    virtual CellRows const& candidates() const = 0;
    /// Sees to candidates for particles of these sizes. True where they are not the ones of before.
    virtual bool prepare(ParticleState const&) { return false; }
    /// Fills all rows.
    virtual void compute_weights(WeightTask const& task) = 0;
    /// Spreads what cells have received further; keeps the sums over all cells.
    virtual void spread(CellSums&) {}
};

/// The method of the case file.
std::unique_ptr<Method> make_method(MappingSettings const& settings, exec::Execution const& execution,
                                    PolyMesh const& mesh);

/// Lanes of the eight numbers from k on that a row of `length` numbers has.
inline int lanes_left(int length, int k)
{
    return length - k < exec::octet ? length - k : exec::octet;
}

/// Scales a row so that it sums to one. Where nothing is found the own cell, the first, takes all.
inline void normalise(double* w, int length)
{
    using exec::Octet;
    Octet sums = Octet::Constant(0);
    for (int k = 0; k < length; k += exec::octet)
        sums = sums + exec::load_first(w + k, lanes_left(length, k));
    double total = sum_of_lanes(sums);
    if (!(total > 0)) w[0] = total = 1;
    Octet const per_total = Octet::Constant(1 / total);
    for (int k = 0; k < length; k += exec::octet)
    {
        int const lanes = lanes_left(length, k);
        exec::store_first(per_total * exec::load_first(w + k, lanes), lanes, w + k);
    }
}

/// Rows of the particles of the i-th occupied cell, by a law(particle, candidates, their number, shares).
template <class Law>
struct RowKernel
{
    std::int32_t const* occupied;
    Quad const* position;
    WeightRows rows;
    Law law;
    double* weights;

    void operator()(std::int64_t i) const
    {
        std::int32_t const c = occupied[i];
        std::int32_t const* const candidates = rows.layer_cells + rows.layer_offsets[c];
        int const length = rows.length(c);
        double* w = weights + rows.first[c];
        for (std::int32_t m = rows.particle_offsets[c]; m < rows.particle_offsets[c + 1]; ++m, w += length)
        {
            law(position[rows.members[m]], candidates, length, w);
            normalise(w, length);
        }
    }
};

/// Fills all rows by a law that is a trivially copyable functor over views.
template <class Law>
void fill_rows(WeightTask const& task, Law const& law)
{
    exec::for_each_uneven(
        task.execution, task.occupied.size(),
        RowKernel<Law>{task.occupied.view().data, task.particles.position.view().data, task.rows, law, task.weights});
}

}  // namespace gimdem

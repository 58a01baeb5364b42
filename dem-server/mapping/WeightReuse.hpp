// SPDX-License-Identifier: BSD-3-Clause
/// Weights that serve again while a particle has hardly moved, theory.md (G.19).
///
/// The weights of a particle are always those of its reference: the place and the cell where they were computed last.
/// So they depend neither on what is kept of them nor on the order of the particles, and a restart needs the references
/// alone.
#pragma once

#include <cstdint>
#include <span>

#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "exec/Sort.hpp"
#include "mapping/Method.hpp"
#include "mapping/RowLayout.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// Where each particle was when its weights were computed.
struct WeightReference
{
    ParticleState particles;          ///< positions and radii; nothing else is set
    exec::Buffer<std::int32_t> cell;  ///< -1: it has no weights yet
};

class WeightReuse
{
public:
    /// `distance`: how far a particle may be from its reference, in its diameters.
    explicit WeightReuse(double distance) : distance_(distance) {}

    WeightReference const& reference() const { return reference_; }
    /// For a run that goes on: as reference() was.
    void restore(WeightReference reference);

    /// The candidates are others: what is kept of weights is of no use any more.
    void forget_rows() { row_.fill(-1); }
    /// As Mapper::permute.
    void permute(std::span<std::int32_t const> order);

    /// What is to be filled.
    struct Rows
    {
        exec::Buffer<std::int32_t> const& cell_order;  ///< of all cells
        exec::Buffer<std::int32_t> const& cell_of;
        exec::Groups const& by_cell;
        RowLayout const& layout;
    };
    /// Fills all rows: copies those of particles near to their references, and lets the method compute the others.
    /// `weights` are those of the last time on entry.
    void fill(exec::Execution const& execution, Method& method, ParticleState const& particles, Rows const& rows,
              exec::Buffer<double>& weights);

private:
    void renew_references(exec::Execution const& execution, ParticleState const& particles, Rows const& rows);
    void compute_missing(exec::Execution const& execution, Method& method, Rows const& rows);
    void collect(exec::Execution const& execution, CellRows const& candidates, Rows const& rows,
                 exec::Buffer<double>& weights);

    double distance_;
    WeightReference reference_;
    exec::Buffer<std::int64_t> row_;  ///< place of each particle's first weight; -1: it is to be computed
    exec::Buffer<std::int32_t> key_;
    exec::Groups missing_by_cell_;
    RowLayout missing_layout_;
    exec::Buffer<double> missing_weights_, weights_before_;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// From particles to cells: where each particle is, its weights w_pi on the cells around it, and sums with them.
///
/// Conservative by construction: the weights of a particle sum to one, so sums over cells equal sums over particles to
/// rounding (theory.md, G.8, C.3). No atomics: each cell sums the particles of the cells around it in stored order.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "exec/Buffer.hpp"
#include "exec/Execution.hpp"
#include "exec/Sort.hpp"
#include "mapping/Method.hpp"
#include "mapping/RowLayout.hpp"
#include "mapping/RowSums.hpp"
#include "mapping/Share.hpp"
#include "mapping/WeightReuse.hpp"
#include "mesh/BoxGrid.hpp"
#include "mesh/PolyMesh.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

class Mapper
{
public:
    Mapper(exec::Execution execution, PolyMesh const& mesh, MappingSettings const& settings = {});

    /// Finds the cell of every particle, walking from the last one. `wall_faces`: shape=(n_faces,), 1 where a face
    /// stops particles. One that left the mesh through an open patch belongs to the last cell before it and is in
    /// left(). Throws UserError, naming the particle and the place, for one that sank deeper into a wall than its
    /// radius.
    void locate(ParticleState const& particles, exec::Buffer<std::uint8_t> const& wall_faces);

    /// Sees to candidates for particles of these sizes. True where layers() are not the ones of before.
    bool prepare(ParticleState const& particles);

    /// Weights of every particle by the method of the settings.
    void compute_weights(ParticleState const& particles);

    /// Sums volumes and impulses into cells.
    void sum_into_cells(ParticleState const& particles, exec::Buffer<Impulse> const& impulses, CellSums& sums);

    /// Particles changed places or number: the particle now at i was at order[i], or is new.
    void permute(std::span<std::int32_t const> order);

    /// Particles that the last locate() found outside of the mesh, beyond the boundary face `face`.
    struct Leaver
    {
        std::int32_t particle, face;
    };
    std::vector<Leaver> const& left() const { return left_; }

    /// For whoever locates elsewhere: none left so far, and a search starts from these cells; none: from scratch.
    void take_cells(exec::Buffer<std::int32_t> cells)
    {
        cell_of_ = std::move(cells);
        sure_.resize(0);
        left_.clear();
    }

    /// Throws UserError, naming the particle and the place: for a particle that must not be outside of the mesh.
    [[noreturn]] static void refuse_outside(ParticleState const& particles, std::int64_t particle);

    exec::Buffer<std::int32_t> const& cell_of() const { return cell_of_; }
    /// A row for each particle, cell after cell and in rising order within a cell: weights on layers() of its cell.
    exec::Buffer<double> const& weights() const { return weights_; }
    CellRows const& layers() const { return method_->candidates(); }

    /// Null unless weights are reused.
    WeightReuse* reuse() { return reuse_ ? &*reuse_ : nullptr; }
    WeightReuse const* reuse() const { return reuse_ ? &*reuse_ : nullptr; }

    // What a device needs to do the same.
    BoxGrid const& cell_grid() const { return cell_grid_; }
    Method& method() { return *method_; }
    exec::Buffer<std::int32_t> const& reverse_slot() const { return reverse_slot_; }

private:
    WeightRows rows() const;

    exec::Execution execution_;
    PolyMesh const& mesh_;
    std::unique_ptr<Method> method_;
    BoxGrid cell_grid_;
    exec::Buffer<std::int32_t> cell_order_;  ///< in which cells are worked on
    /// For entry k of layers: place of the row's cell in the row of cells[k].
    exec::Buffer<std::int32_t> reverse_slot_;
    exec::Buffer<std::int32_t> cell_of_;
    exec::Buffer<Quad> sure_;  ///< as LocateMovedKernel::sure
    exec::Groups by_cell_;
    std::vector<Leaver> left_;
    RowLayout layout_;
    exec::Buffer<double> weights_;
    std::optional<WeightReuse> reuse_;
    RowSums cell_sums_;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/Mapper.hpp"

#include <fmt/format.h>

#include "core/Error.hpp"
#include "exec/ForEach.hpp"
#include "mapping/PermuteWithNew.hpp"
#include "mapping/SureCell.hpp"
#include "mesh/NearbyCells.hpp"
#include "mesh/ReverseSlots.hpp"
#include "mesh/SpatialOrder.hpp"

namespace gimdem
{

namespace
{

constexpr Quad nowhere{0, 0, 0, -1};

}  // namespace

Mapper::Mapper(exec::Execution execution, PolyMesh const& mesh, MappingSettings const& settings)
    : execution_(execution),
      mesh_(mesh),
      method_(make_method(settings, execution, mesh)),
      cell_grid_(cell_boxes(mesh)),
      cell_order_(spatial_order(mesh))
{
    reverse_slot_ = reverse_slots(method_->candidates());
    if (settings.reuse_distance > 0) reuse_.emplace(settings.reuse_distance);
}

void Mapper::locate(ParticleState const& particles, exec::Buffer<std::uint8_t> const& wall_faces)
{
    std::int64_t const n = particles.count();
    if (cell_of_.size() != n)
    {
        cell_of_.resize(n);
        cell_of_.fill(-1);
    }
    if (sure_.size() != n)
    {
        sure_.resize(n);
        sure_.fill(nowhere);
    }
    CellFinder const find{mesh_.view(), cell_grid_.view()};
    exec::Buffer<std::uint8_t> status(n);
    exec::for_each(execution_, n,
                   LocateMovedKernel{{find, particles.position.view().data, wall_faces.view().data,
                                      cell_of_.view().data, status.view().data},
                                     sure_.view().data});
    left_.clear();
    for (std::int64_t p = 0; p < n; ++p)
    {
        if (status[p] == 2) refuse_outside(particles, p);
        if (status[p] == 1)
            left_.push_back({static_cast<std::int32_t>(p), find(cell_of_[p], particles.position[p].xyz()).face});
    }
    exec::group_by_key(execution_, cell_of_.host(), mesh_.cell_count(), by_cell_);
}

void Mapper::refuse_outside(ParticleState const& particles, std::int64_t particle)
{
    Vec3 const x = particles.position[particle].xyz();
    throw UserError(
        fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m is outside the mesh (its void fraction has "
                    "no cell); it starts beyond an open patch or sank into a wall: check the insertion "
                    "box, [walls] also, the height of the mesh, and the time step",
                    particles.id[particle], x.x(), x.y(), x.z()));
}

WeightRows Mapper::rows() const
{
    return layout_.rows(method_->candidates(), by_cell_);
}

bool Mapper::prepare(ParticleState const& particles)
{
    if (!method_->prepare(particles)) return false;
    reverse_slot_ = reverse_slots(method_->candidates());
    return true;
}

void Mapper::compute_weights(ParticleState const& particles)
{
    bool const others = prepare(particles);
    layout_.lay_out(method_->candidates(), by_cell_, cell_order_);
    cell_sums_.lay_out(method_->candidates(), layout_.occupied, cell_order_);
    if (reuse_)
    {
        if (others) reuse_->forget_rows();
        return reuse_->fill(execution_, *method_, particles, {cell_order_, cell_of_, by_cell_, layout_}, weights_);
    }
    weights_.resize(layout_.weight_count);
    method_->compute_weights({execution_, particles, layout_.occupied, rows(), weights_.view().data});
}

void Mapper::sum_into_cells(ParticleState const& particles, exec::Buffer<Impulse> const& impulses, CellSums& sums)
{
    cell_sums_.sum(execution_,
                   {rows(), weights_.view().data, particles.position.view().data,
                    impulses.size() == particles.count() ? impulses.view().data : nullptr},
                   reverse_slot_, sums);
    method_->spread(sums);
}

void Mapper::permute(std::span<std::int32_t const> order)
{
    if (reuse_) reuse_->permute(order);
    std::int64_t const before = cell_of_.size();
    if (before == 0) return;
    permute_with_new(cell_of_, order, -1);  // new ones are to be located from scratch
    if (sure_.size() == before) permute_with_new(sure_, order, nowhere);
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/Mapper.hpp"

#include <fmt/format.h>

#include "core/Error.hpp"
#include "exec/ForEach.hpp"
#include "mapping/LocateKernel.hpp"
#include "mesh/NearbyCells.hpp"

namespace gimdem
{

namespace
{

/// What the particles of the i-th occupied cell give to its candidates.
struct GiveKernel
{
    std::int32_t const* occupied;
    WeightRows rows;
    double const* weights;
    Quad const* position;
    Impulse const* impulses;  ///< null: volumes only
    std::int64_t const* first_share;
    Share* shares;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int32_t const c = occupied[i];
        int const length = rows.length(c);
        Share* const to = shares + first_share[c];
        for (int k = 0; k < length; ++k)
            to[k] = {};
        double const* w = weights + rows.first[c];
        for (std::int32_t m = rows.particle_offsets[c]; m < rows.particle_offsets[c + 1]; ++m, w += length)
        {
            Share const whole = share_of(rows.members[m]);
            for (int k = 0; k < length; ++k)
                to[k].add(w[k], whole);
        }
    }

private:
    GIMDEM_HD Share share_of(std::int32_t p) const
    {
        Share whole{{0, 0, 0, 0}, sphere_volume(position[p].w)};
        if (impulses != nullptr) whole.drag = impulses[p].drag;
        return whole;
    }
};

/// Sums of the i-th cell that receives: its shares of the particles in the cells around it.
struct TakeKernel
{
    std::int32_t const* receivers;
    std::int32_t const* layer_offsets;
    std::int32_t const* layer_cells;
    std::int32_t const* reverse_slot;
    std::int64_t const* first_share;
    Share const* shares;
    double* solid_volume;
    Quad* drag;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int32_t const c = receivers[i];
        Share sum{};
        for (std::int32_t k = layer_offsets[c]; k < layer_offsets[c + 1]; ++k)
        {
            std::int64_t const first = first_share[layer_cells[k]];
            if (first >= 0) sum.add(1, shares[first + reverse_slot[k]]);
        }
        solid_volume[c] = sum.volume;
        drag[c] = sum.drag;
    }
};

}  // namespace

Mapper::Mapper(exec::Execution execution, PolyMesh const& mesh, MappingSettings const& settings)
    : execution_(execution), mesh_(mesh), method_(make_method(settings, execution, mesh)), cell_grid_(cell_boxes(mesh))
{
    find_reverse_slots();
    if (settings.reuse_distance > 0) reuse_.emplace(settings.reuse_distance);
}

void Mapper::find_reverse_slots()
{
    CellRows const& layers = method_->candidates();
    reverse_slot_.resize(layers.cells.size());
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
        for (std::int32_t k = layers.offsets[c]; k < layers.offsets[c + 1]; ++k)
        {
            std::int32_t const other = layers.cells[k];
            std::int32_t slot = 0;
            while (layers.cells[layers.offsets[other] + slot] != c)
                ++slot;
            reverse_slot_[k] = slot;
        }
}

void Mapper::locate(ParticleState const& particles, exec::Buffer<std::uint8_t> const& wall_faces)
{
    std::int64_t const n = particles.count();
    if (cell_of_.size() != n)
    {
        cell_of_.resize(n);
        cell_of_.fill(-1);
    }
    CellFinder const find{mesh_.view(), cell_grid_.view()};
    exec::Buffer<std::uint8_t> status(n);
    exec::for_each(execution_, n,
                   LocateKernel{find, particles.position.view().data, wall_faces.view().data, cell_of_.view().data,
                                status.view().data});
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

void Mapper::lay_out_rows()
{
    CellRows const& layers = method_->candidates();
    layout_.lay_out(layers, by_cell_, mesh_.cell_count());
    first_share_.resize(mesh_.cell_count());
    first_share_.fill(-1);
    std::int64_t n_shares = 0;
    for (std::int32_t const c : layout_.occupied.host())
    {
        first_share_[c] = n_shares;
        n_shares += layers.offsets[c + 1] - layers.offsets[c];
    }
    shares_.resize(n_shares);
    find_receivers();
}

// Occupied cells and their candidates; where that is most of the mesh, all cells, without looking.
void Mapper::find_receivers()
{
    CellRows const& layers = method_->candidates();
    receivers_.resize(mesh_.cell_count());
    receives_.resize(mesh_.cell_count());
    receives_.fill(2 * layout_.occupied.size() > mesh_.cell_count());
    for (std::int32_t const c : layout_.occupied.host())
        for (std::int32_t k = layers.offsets[c]; k < layers.offsets[c + 1]; ++k)
            receives_[layers.cells[k]] = 1;
    std::int64_t count = 0;
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
    {
        receivers_[count] = c;
        count += receives_[c];
    }
    receivers_.resize(count);
}

WeightRows Mapper::rows() const
{
    return layout_.rows(method_->candidates(), by_cell_);
}

bool Mapper::prepare(ParticleState const& particles)
{
    if (!method_->prepare(particles)) return false;
    find_reverse_slots();
    return true;
}

void Mapper::compute_weights(ParticleState const& particles)
{
    bool const others = prepare(particles);
    lay_out_rows();
    if (reuse_)
    {
        if (others) reuse_->forget_rows();
        return reuse_->fill(execution_, *method_, particles, {mesh_.cell_count(), cell_of_, by_cell_, layout_},
                            weights_);
    }
    weights_.resize(layout_.weight_count);
    method_->compute_weights({execution_, particles, layout_.occupied, rows(), weights_.view().data});
}

void Mapper::sum_into_cells(ParticleState const& particles, exec::Buffer<Impulse> const& impulses, CellSums& sums)
{
    exec::for_each_uneven(
        execution_, layout_.occupied.size(),
        GiveKernel{layout_.occupied.view().data, rows(), weights_.view().data, particles.position.view().data,
                   impulses.size() == particles.count() ? impulses.view().data : nullptr, first_share_.view().data,
                   shares_.view().data});
    sums.solid_volume.resize(mesh_.cell_count());
    sums.drag.resize(mesh_.cell_count());
    sums.solid_volume.fill(0);
    sums.drag.fill({0, 0, 0, 0});
    exec::for_each(execution_, receivers_.size(),
                   TakeKernel{receivers_.view().data, rows().layer_offsets, rows().layer_cells,
                              reverse_slot_.view().data, first_share_.view().data, shares_.view().data,
                              sums.solid_volume.view().data, sums.drag.view().data});
    method_->spread(sums);
}

void Mapper::permute(std::span<std::int32_t const> order)
{
    if (reuse_) reuse_->permute(order);
    std::int64_t const before = cell_of_.size(), after = std::ssize(order);
    if (before == 0) return;
    if (after > before) cell_of_.resize(after);
    for (std::int64_t p = before; p < after; ++p)
        cell_of_[p] = -1;  // new: to be located from scratch
    gimdem::permute(cell_of_, order);
    cell_of_.resize(after);
}

}  // namespace gimdem

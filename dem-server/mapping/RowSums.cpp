// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/RowSums.hpp"

#include "exec/ForEach.hpp"
#include "exec/Selection.hpp"

namespace gimdem
{

namespace
{

/// What the particles of the i-th occupied cell give to its candidates, eight candidates at a time.
struct GiveKernel
{
    std::int32_t const* occupied;
    WeightedParticles of;
    std::int64_t const* first_share;
    Quad* drag;
    double* volume;

    void operator()(std::int64_t i) const
    {
        std::int32_t const c = occupied[i];
        std::int64_t const first = first_share[c];
        for (int k = 0; k < of.rows.length(c); k += exec::octet)
            give(c, k, drag + first + k, volume + first + k);
    }

private:
    void give(std::int32_t c, int k, Quad* to_drag, double* to_volume) const
    {
        using exec::Octet;
        using exec::plus_product;
        int const length = of.rows.length(c), lanes = lanes_left(length, k);
        Octet const zero = Octet::Constant(0);
        exec::OctetOfQuads drag_sum{zero, zero, zero, zero};
        Octet volume_sum = zero;
        double const* w = of.weights + of.rows.first[c] + k;
        for (std::int32_t m = of.rows.particle_offsets[c]; m < of.rows.particle_offsets[c + 1]; ++m, w += length)
        {
            std::int32_t const p = of.rows.members[m];
            Octet const weight = exec::load_first(w, lanes);
            volume_sum = plus_product(volume_sum, weight, Octet::Constant(sphere_volume(of.position[p].w)));
            if (of.impulses == nullptr) continue;
            Quad const& impulse = of.impulses[p].drag;
            drag_sum.x = plus_product(drag_sum.x, weight, Octet::Constant(impulse.x));
            drag_sum.y = plus_product(drag_sum.y, weight, Octet::Constant(impulse.y));
            drag_sum.z = plus_product(drag_sum.z, weight, Octet::Constant(impulse.z));
            drag_sum.w = plus_product(drag_sum.w, weight, Octet::Constant(impulse.w));
        }
        exec::store(drag_sum, to_drag);
        exec::store_first(volume_sum, exec::octet, to_volume);
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
    Quad const* drag_shares;
    double const* volume_shares;
    double* solid_volume;
    Quad* drag;

    void operator()(std::int64_t i) const
    {
        std::int32_t const c = receivers[i];
        Quad drag_sum{0, 0, 0, 0};
        double volume_sum = 0;
        for (std::int32_t k = layer_offsets[c]; k < layer_offsets[c + 1]; ++k)
        {
            std::int64_t const first = first_share[layer_cells[k]];
            if (first < 0) continue;
            std::int64_t const at = first + reverse_slot[k];
            drag_sum = drag_sum + drag_shares[at];
            volume_sum += volume_shares[at];
        }
        solid_volume[c] = volume_sum;
        drag[c] = drag_sum;
    }
};

}  // namespace

void RowSums::lay_out(CellRows const& layers, exec::Buffer<std::int32_t> const& occupied,
                      exec::Buffer<std::int32_t> const& cell_order)
{
    cell_count_ = static_cast<std::int32_t>(layers.offsets.size()) - 1;
    occupied_ = occupied;
    first_share_.resize(cell_count_);
    first_share_.fill(-1);
    std::int64_t count = 0;
    for (std::int32_t const c : occupied_.host())
    {
        first_share_[c] = count;
        std::int32_t const length = layers.offsets[c + 1] - layers.offsets[c];
        count += (length + exec::octet - 1) / exec::octet * exec::octet;
    }
    drag_shares_.resize(count);
    volume_shares_.resize(count);
    find_receivers(layers, cell_order);
}

// Occupied cells and their candidates; where that is most of the mesh, all cells, without looking.
void RowSums::find_receivers(CellRows const& layers, exec::Buffer<std::int32_t> const& cell_order)
{
    receivers_.resize(cell_count_);
    bool const most = 2 * occupied_.size() > cell_count_;
    receives_.resize(cell_count_);
    receives_.fill(most);
    if (!most)
        for (std::int32_t const c : occupied_.host())
            for (std::int32_t k = layers.offsets[c]; k < layers.offsets[c + 1]; ++k)
                receives_[layers.cells[k]] = 1;
    std::int64_t count = 0;
    for (std::int32_t const c : cell_order.host())
    {
        receivers_[count] = c;
        count += receives_[c];
    }
    receivers_.resize(count);
}

void RowSums::sum(exec::Execution const& execution, WeightedParticles const& of,
                  exec::Buffer<std::int32_t> const& reverse_slot, CellSums& sums)
{
    exec::for_each_uneven(execution, occupied_.size(),
                          GiveKernel{occupied_.view().data, of, first_share_.view().data, drag_shares_.view().data,
                                     volume_shares_.view().data});
    sums.solid_volume.resize(cell_count_);
    sums.drag.resize(cell_count_);
    sums.solid_volume.fill(0);
    sums.drag.fill({0, 0, 0, 0});
    exec::for_each(execution, receivers_.size(),
                   TakeKernel{receivers_.view().data, of.rows.layer_offsets, of.rows.layer_cells,
                              reverse_slot.view().data, first_share_.view().data, drag_shares_.view().data,
                              volume_shares_.view().data, sums.solid_volume.view().data, sums.drag.view().data});
}

}  // namespace gimdem

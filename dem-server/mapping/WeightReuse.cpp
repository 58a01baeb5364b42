// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/WeightReuse.hpp"

#include <algorithm>
#include <utility>

#include "exec/ForEach.hpp"
#include "mapping/PermuteWithNew.hpp"

namespace gimdem
{

namespace
{

/// Whoever changed cell or size or is too far from its reference has a new one.
struct RenewKernel
{
    double distance;  ///< in diameters
    Quad const* position;
    std::int32_t const* cell_of;
    Quad* reference;
    std::int32_t* reference_cell;
    std::int64_t* row;

    GIMDEM_HD void operator()(std::int64_t p) const
    {
        Quad const x = position[p];
        double const limit = 2 * x.w * distance;
        bool const is_near = (x.xyz() - reference[p].xyz()).squaredNorm() <= limit * limit;
        if (reference_cell[p] == cell_of[p] && reference[p].w == x.w && is_near) return;
        reference[p] = x;
        reference_cell[p] = cell_of[p];
        row[p] = -1;
    }
};

/// Rows of the particles of the i-th occupied cell, from where they are.
struct CollectKernel
{
    std::int32_t const* occupied;
    WeightRows rows;
    std::int64_t const* first_missing;
    double const* missing;
    double const* before;
    std::int64_t* row;
    double* weights;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int32_t const c = occupied[i];
        int const length = rows.length(c);
        std::int64_t to = rows.first[c], next_missing = first_missing[c];
        for (std::int32_t m = rows.particle_offsets[c]; m < rows.particle_offsets[c + 1]; ++m, to += length)
        {
            std::int64_t& at = row[rows.members[m]];
            double const* const from = at < 0 ? missing + next_missing : before + at;
            if (at < 0) next_missing += length;
            for (int k = 0; k < length; ++k)
                weights[to + k] = from[k];
            at = to;
        }
    }
};

}  // namespace

void WeightReuse::restore(WeightReference reference)
{
    reference_ = std::move(reference);
    row_.resize(reference_.cell.size());
    forget_rows();
}

void WeightReuse::permute(std::span<std::int32_t const> order)
{
    if (row_.size() == 0) return;
    permute_with_new(reference_.particles.position, order, Quad{0, 0, 0, 0});
    permute_with_new(reference_.cell, order, -1);
    permute_with_new(row_, order, std::int64_t{-1});
}

void WeightReuse::fill(exec::Execution const& execution, Method& method, ParticleState const& particles,
                       Rows const& rows, exec::Buffer<double>& weights)
{
    renew_references(execution, particles, rows);
    compute_missing(execution, method, rows);
    collect(execution, method.candidates(), rows, weights);
}

void WeightReuse::renew_references(exec::Execution const& execution, ParticleState const& particles, Rows const& rows)
{
    std::int64_t const n = particles.count();
    if (row_.size() != n)
    {
        reference_.particles.position.resize(n);
        reference_.cell.resize(n);
        reference_.cell.fill(-1);
        row_.resize(n);
        forget_rows();
    }
    exec::for_each(
        execution, n,
        RenewKernel{distance_, particles.position.view().data, rows.cell_of.view().data,
                    reference_.particles.position.view().data, reference_.cell.view().data, row_.view().data});
}

void WeightReuse::compute_missing(exec::Execution const& execution, Method& method, Rows const& rows)
{
    // All others are a group of their own, behind the cells.
    key_.resize(row_.size());
    exec::for_each(execution, row_.size(),
                   [key = key_.view(), row = row_.view(), cell = rows.cell_of.view(),
                    none = static_cast<std::int32_t>(rows.cell_order.size())](std::int64_t p)
                   { key[p] = row[p] < 0 ? cell[p] : none; });
    exec::group_by_key(execution, key_.host(), rows.cell_order.size() + 1, missing_by_cell_);
    missing_layout_.lay_out(method.candidates(), missing_by_cell_, rows.cell_order);
    missing_weights_.resize(missing_layout_.weight_count);
    method.compute_weights({execution, reference_.particles, missing_layout_.occupied,
                            missing_layout_.rows(method.candidates(), missing_by_cell_), missing_weights_.view().data});
}

void WeightReuse::collect(exec::Execution const& execution, CellRows const& candidates, Rows const& rows,
                          exec::Buffer<double>& weights)
{
    swap(weights, weights_before_);
    weights.resize(rows.layout.weight_count);
    exec::for_each_uneven(execution, rows.layout.occupied.size(),
                          CollectKernel{rows.layout.occupied.view().data, rows.layout.rows(candidates, rows.by_cell),
                                        missing_layout_.first.view().data, missing_weights_.view().data,
                                        weights_before_.view().data, row_.view().data, weights.view().data});
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/CellCurves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exec/ForEach.hpp"
#include "mapping/TabulatedIntegral.hpp"

namespace gimdem
{

namespace
{

using Fit = ChebyshevFit<CellCurve::degree + 1>;

/// One curve; says how far it is off at most.
class CurveMaker
{
public:
    CurveMaker(double radius, double volume, double fixed_coefficient)
        : integral_(radius, volume, fixed_coefficient), end_(integral_.end(0.1 * CellCurves::error_bound))
    {
    }

    double make(CellCurve& curve, Quad const& cell) const
    {
        curve.cell = cell;
        double const t2 = integral_.narrow * integral_.narrow;
        double const x4 = std::pow(CellCurve::intervals, 4) / (end_ * end_);
        curve.scale = x4 / t2;
        curve.offset = x4 * integral_.crossing2;
        double worst = 0;
        for (int i = 0; i < CellCurve::intervals; ++i)
            worst = std::max(worst, make_interval(curve, i));
        return worst;
    }

private:
    /// I / V_p at x = i + 1/2 + u.
    double at(int i, long double u) const
    {
        auto const part = static_cast<double>((i + 0.5L + u) / CellCurve::intervals);
        return integral_(end_ * part * part);
    }

    double make_interval(CellCurve& curve, int i) const
    {
        Fit::Terms values;
        for (int k = 0; k < values.size(); ++k)
            values[k] = at(i, Fit::node(k));
        Fit::Terms const c = Fit::coefficients(values);
        for (int j = 0; j < c.size(); ++j)
            curve.coefficients[j][i] = static_cast<double>(c[j]);

        // Where the product of the distances from the nodes is largest: half-way between them, and at the ends.
        double worst = 0;
        constexpr int gaps = CellCurve::degree + 1;
        for (int k = 0; k <= gaps; ++k)
        {
            long double const u = std::cos(std::numbers::pi_v<long double> * k / gaps) / 2;
            worst = std::max(worst, std::abs(static_cast<double>(Fit::value(c, u)) - at(i, u)));
        }
        return worst;
    }

    TabulatedIntegral integral_;
    double end_;
};

/// The i-th pair that is missing, to the i-th place from `first` on.
struct MakeKernel
{
    std::int64_t const* missing;
    std::int64_t cell_count;
    double const* radii;
    Quad const* cell;
    double fixed_coefficient;
    std::int32_t first;
    std::int32_t too_coarse;
    CellCurve* curves;
    std::int32_t* curve_of;

    void operator()(std::int64_t i) const
    {
        std::int64_t const pair = missing[i];
        std::int32_t const place = first + static_cast<std::int32_t>(i);
        double const error =
            make_curve(curves[place], radii[pair / cell_count], cell[pair % cell_count], fixed_coefficient);
        curve_of[pair] = 2 * error < CellCurves::error_bound ? place : too_coarse;
    }
};

}  // namespace

double make_curve(CellCurve& curve, double radius, Quad const& cell, double fixed_coefficient)
{
    return CurveMaker(radius, cell.w, fixed_coefficient).make(curve, cell);
}

bool CellCurves::provide(WeightTask const& task)
{
    usable_ = usable_ && add_radii(task.particles);
    if (!usable_) return false;
    list_missing(task);
    if (missing_.size() == 0) return true;
    std::int64_t const first = curves_.size();
    curves_.resize(first + missing_.size());
    exec::for_each_uneven(
        task.execution, missing_.size(),
        MakeKernel{missing_.view().data, mesh_.cell_count(), radii_.view().data, mesh_.view().cell, fixed_coefficient_,
                   static_cast<std::int32_t>(first), too_coarse, curves_.view().data, curve_of_.view().data});
    return true;
}

bool CellCurves::add_radii(ParticleState const& particles)
{
    double last = 0;
    for (std::int64_t p = 0; p < particles.count(); ++p)
    {
        double const radius = particles.position[p].w;
        if (radius == last) continue;
        last = radius;
        if (std::ranges::find(radii_.host(), radius) != radii_.host().end()) continue;
        std::int64_t const row = radii_.size(), cells = mesh_.cell_count();
        if (row == most_radii || (row + 1) * cells > most_pairs) return false;
        radii_.resize(row + 1);
        radii_[row] = radius;
        curve_of_.resize((row + 1) * cells);
        std::fill_n(curve_of_.host().begin() + row * cells, cells, not_made);
        seen_.resize(cells);
        seen_.fill(0);
    }
    return true;
}

void CellCurves::list_missing(WeightTask const& task)
{
    constexpr std::int32_t listed = -3;
    missing_.resize(0);
    for (std::int32_t const c : task.occupied.host())
    {
        if (seen_[c] != 0) continue;
        seen_[c] = 1;
        for (std::int32_t k = 0; k < task.rows.length(c); ++k)
            for (std::int64_t row = 0; row < radii_.size(); ++row)
            {
                std::int64_t const pair =
                    row * mesh_.cell_count() + task.rows.layer_cells[task.rows.layer_offsets[c] + k];
                if (curve_of_[pair] != not_made) continue;
                curve_of_[pair] = listed;
                missing_.resize(missing_.size() + 1);
                missing_[missing_.size() - 1] = pair;
            }
    }
}

CellCurvesView CellCurves::view() const
{
    return {radii_.view().data, curve_of_.view().data, curves_.view().data, static_cast<std::int32_t>(radii_.size()),
            mesh_.cell_count()};
}

}  // namespace gimdem

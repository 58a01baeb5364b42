// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/GaussianTable.hpp"

#include <algorithm>
#include <numeric>

#include "mapping/CellCurves.hpp"
#include "mapping/TabulatedIntegral.hpp"

namespace gimdem
{

GaussianTables::GaussianTables(PolyMesh const& mesh, double fixed_coefficient) : fixed_coefficient_(fixed_coefficient)
{
    volumes_.resize(static_cast<std::size_t>(mesh.cell_count()));
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        volumes_[static_cast<std::size_t>(c)] = mesh.volume(c);

    std::vector<std::size_t> order(volumes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t c) { return volumes_[c]; });
    class_of_.resize(volumes_.size());
    for (std::size_t const c : order)
    {
        if (class_volumes_.empty() || volumes_[c] > class_volumes_.back() * (1 + class_tolerance))
            class_volumes_.push_back(volumes_[c]);
        class_of_[c] = static_cast<std::int32_t>(class_volumes_.size()) - 1;
    }
}

bool GaussianTables::provide(ParticleState const& particles)
{
    double last = 0;
    for (std::int64_t p = 0; usable_ && p < particles.count(); ++p)
    {
        double const radius = particles.position[p].w;
        if (radius == last) continue;
        last = radius;
        if (std::ranges::find(radii_.host(), radius) == radii_.host().end()) add_row(radius);
    }
    return usable_;
}

void GaussianTables::add_row(double radius)
{
    std::int64_t const row = radii_.size();
    usable_ = (static_cast<std::size_t>(row) + 1) * class_volumes_.size() <= most_tables;
    if (!usable_) return;
    radii_.resize(row + 1);
    radii_[row] = radius;
    std::int64_t const first_table = coefficients_.size();
    std::vector<double> interval;
    for (double const volume : class_volumes_)
        interval.push_back(add_table(radius, volume));

    // The argument is each cell's own, so that classes are joined without a step.
    auto const cells = static_cast<std::int64_t>(volumes_.size());
    pairs_.resize((row + 1) * cells);
    for (std::int64_t c = 0; c < cells; ++c)
    {
        auto const k = static_cast<std::size_t>(class_of_[static_cast<std::size_t>(c)]);
        TabulatedIntegral const pair(radius, volumes_[static_cast<std::size_t>(c)], fixed_coefficient_);
        double const h = interval[k];
        pairs_[row * cells + c] = {1 / (pair.narrow * pair.narrow * h * h), pair.crossing2 / (h * h),
                                   first_table + static_cast<std::int64_t>(k) * GaussianTableView::length};
    }
}

double GaussianTables::add_table(double radius, double volume)
{
    constexpr int intervals = GaussianTableView::intervals;
    using Fit = ChebyshevFit<GaussianTableView::degree + 1>;
    TabulatedIntegral const pair(radius, volume, fixed_coefficient_);
    double const h = pair.end(1e-18) / intervals;
    std::int64_t const place = coefficients_.size();
    coefficients_.resize(place + GaussianTableView::length);
    double* const table = coefficients_.view().data + place;
    std::fill_n(table, GaussianTableView::length, 0.0);
    for (int i = 0; i < intervals; ++i)
    {
        Fit::Terms values;
        for (int k = 0; k < values.size(); ++k)
            values[k] = pair(h * static_cast<double>(i + 0.5L + Fit::node(k)));
        Fit::Terms const c = Fit::coefficients(values);
        for (int j = 0; j < c.size(); ++j)
            table[j * GaussianTableView::stride + i] = static_cast<double>(c[j]);

        // The polynomial strays farthest from the function at its ends, next to the outermost nodes.
        double const error = std::max(std::abs(static_cast<double>(Fit::value(c, -0.5L)) - pair(h * i)),
                                      std::abs(static_cast<double>(Fit::value(c, 0.5L)) - pair(h * (i + 1))));
        usable_ = usable_ && error < error_bound;
    }
    add_curve(radius, volume, h * pair.narrow);
    return h;
}

void GaussianTables::add_curve(double radius, double volume, double interval)
{
    curves_.resize(curves_.size() + 1);
    SharedCurve& shared = curves_[curves_.size() - 1];
    double const error = make_curve(shared.curve, radius, {0, 0, 0, volume}, fixed_coefficient_);
    shared.per_table = 2 * error < error_bound ? shared.curve.scale * interval * interval : 0;
}

GaussianTableView GaussianTables::view() const
{
    return {radii_.view().data, pairs_.view().data, coefficients_.view().data, static_cast<std::int32_t>(radii_.size()),
            static_cast<std::int32_t>(volumes_.size())};
}

}  // namespace gimdem

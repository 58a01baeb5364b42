// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/GaussianTable.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numbers>
#include <numeric>

#include "mapping/GaussianIntegral.hpp"

namespace gimdem
{

namespace
{

constexpr int intervals = GaussianTableView::intervals;
constexpr int terms = GaussianTableView::degree + 1;
using Terms = Eigen::Matrix<long double, terms, 1>;

/// I / V_p of one radius and one volume over t, where mu^2 = narrow^2 (t^2 + crossing2).
struct TabulatedIntegral
{
    GaussianIntegral integral;
    double narrow;     ///< deviation of the narrower Gaussian [m]
    double crossing2;  ///< (mu / narrow)^2 where the two begin to cross: 4 (s^2 - 1) ln s

    TabulatedIntegral(double radius, double volume, double fixed_coefficient)
    {
        double const log_ratio = std::log(volume / sphere_volume(radius));
        double const log_s = std::abs(log_ratio) / 3;
        integral = {radius, log_ratio, fixed_coefficient > 0 ? fixed_coefficient : tuned_coefficient(log_ratio)};
        narrow = integral.coefficient * radius * std::exp(std::min(0.0, log_ratio / 3));
        crossing2 = 4 * std::expm1(2 * log_s) * log_s;
    }

    double operator()(double t) const { return integral(narrow * std::sqrt(t * t + crossing2)); }

    /// The t beyond which the integral is nothing.
    double end() const
    {
        double low = 0, high = 1;
        while ((*this)(high) > 1e-18)
            high *= 2;
        while (high - low > 1e-3 * high)
            ((*this)((low + high) / 2) > 1e-18 ? low : high) = (low + high) / 2;
        return high;
    }
};

/// Chebyshev's points of [-1/2, 1/2].
long double node(int k)
{
    return std::cos(std::numbers::pi_v<long double> * (k + 0.5L) / terms) / 2;
}

/// Maps a function's values at the nodes to the coefficients of the polynomial through them.
Eigen::Matrix<long double, terms, terms> interpolation()
{
    Eigen::Matrix<long double, terms, terms> powers;
    for (int k = 0; k < terms; ++k)
        for (int j = 0; j < terms; ++j)
            powers(k, j) = std::pow(node(k), static_cast<long double>(j));
    return powers.inverse();
}

}  // namespace

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
    static auto const to_coefficients = interpolation();
    TabulatedIntegral const pair(radius, volume, fixed_coefficient_);
    double const h = pair.end() / intervals;
    std::int64_t const place = coefficients_.size();
    coefficients_.resize(place + GaussianTableView::length);
    double* const table = coefficients_.view().data + place;
    std::fill_n(table, GaussianTableView::length, 0.0);
    for (int i = 0; i < intervals; ++i)
    {
        Terms values;
        for (int k = 0; k < terms; ++k)
            values[k] = pair(h * static_cast<double>(i + 0.5L + node(k)));
        Terms const c = to_coefficients * values;
        for (int j = 0; j < terms; ++j)
            table[j * GaussianTableView::stride + i] = static_cast<double>(c[j]);

        // The polynomial strays farthest from the function at its ends, next to the outermost nodes.
        long double low = 0, high = 0;
        for (int j = terms - 1; j >= 0; --j)
        {
            low = low * -0.5L + c[j];
            high = high * 0.5L + c[j];
        }
        double const error = std::max(std::abs(static_cast<double>(low) - pair(h * i)),
                                      std::abs(static_cast<double>(high) - pair(h * (i + 1))));
        usable_ = usable_ && error < error_bound;
    }
    return h;
}

GaussianTableView GaussianTables::view() const
{
    return {radii_.view().data, pairs_.view().data, coefficients_.view().data, static_cast<std::int32_t>(radii_.size()),
            static_cast<std::int32_t>(volumes_.size())};
}

}  // namespace gimdem

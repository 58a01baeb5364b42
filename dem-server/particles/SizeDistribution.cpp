// SPDX-License-Identifier: BSD-3-Clause
#include "particles/SizeDistribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/Error.hpp"

namespace gimdem
{

namespace
{

/// Shares by number of sizes whose shares by mass are given, theory.md (D.63), summed up.
std::vector<double> cumulated_by_number(SizeSettings const& sizes)
{
    std::vector<double> up_to;
    double sum = 0;
    for (std::size_t k = 0; k < sizes.diameters.size(); ++k)
        up_to.push_back(sum += sizes.mass_fractions[k] / std::pow(sizes.diameters[k], 3));
    for (double& value : up_to)
        value /= sum;
    return up_to;
}

}  // namespace

SizeDistribution::SizeDistribution(double diameter, std::optional<SizeSettings> const& sizes)
    : settings_(sizes.value_or(SizeSettings{})), smallest_(diameter), largest_(diameter)
{
    if (!sizes) return;
    smallest_ = settings_.minimum;
    largest_ = settings_.maximum;
    if (settings_.distribution == "discrete")
    {
        auto const [least, most] = std::minmax_element(settings_.diameters.begin(), settings_.diameters.end());
        smallest_ = *least;
        largest_ = *most;
        up_to_ = cumulated_by_number(settings_);
        return;
    }
    if (settings_.distribution == "uniform") return;
    centre_ = settings_.mean;
    width_ = settings_.deviation;
    if (settings_.distribution == "lognormal")
    {
        double const relative = settings_.deviation / settings_.mean;
        width_ = std::sqrt(std::log1p(relative * relative));
        centre_ = std::log(settings_.mean) - 0.5 * width_ * width_;
    }
    // Less weight than this, and the inverse (D.61) is made of rounding errors.
    double const weight = share_below(largest_) - share_below(smallest_);
    if (!(weight > 1e-6))
        throw UserError(
            fmt::format("[sizes] {} distribution of mean {:.6g} m and deviation {:.6g} m has next to no diameters "
                        "between {:.6g} m and {:.6g} m (a share of {:.2g}); move minimum and maximum around the mean",
                        settings_.distribution, settings_.mean, settings_.deviation, smallest_, largest_, weight));
}

double SizeDistribution::draw(RandomStream& random) const
{
    double const u = random.unit();
    if (settings_.distribution.empty()) return smallest_;
    if (settings_.distribution == "uniform") return smallest_ + u * (largest_ - smallest_);  // (D.60)
    return settings_.distribution == "discrete" ? draw_discrete(u) : draw_bell(u);
}

double SizeDistribution::share_below(double d) const
{
    double const at = settings_.distribution == "lognormal" ? std::log(d) : d;
    return 0.5 * std::erfc((centre_ - at) / (width_ * std::sqrt(2.0)));
}

double SizeDistribution::draw_discrete(double u) const
{
    auto const found = std::upper_bound(up_to_.begin(), up_to_.end(), u);
    auto const k = std::min<std::ptrdiff_t>(found - up_to_.begin(), std::ssize(up_to_) - 1);
    return settings_.diameters[static_cast<std::size_t>(k)];
}

// (D.61) by bisection: 48 halvings leave 4e-15 of the range.
double SizeDistribution::draw_bell(double u) const
{
    double const below = share_below(smallest_);
    double const target = below + u * (share_below(largest_) - below);
    double low = smallest_, high = largest_;
    for (int k = 0; k < 48; ++k)
    {
        double const middle = 0.5 * (low + high);
        (share_below(middle) < target ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace gimdem

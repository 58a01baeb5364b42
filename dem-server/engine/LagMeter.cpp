// SPDX-License-Identifier: BSD-3-Clause
#include "engine/LagMeter.hpp"

#include <cmath>

namespace gimdem
{

namespace
{

/// sqrt(changed / whole), 0 where there is nothing to be relative to.
double relative(double changed, double whole)
{
    return whole > 0 ? std::sqrt(changed / whole) : 0;
}

void keep(coupling::Span<double const> field, std::vector<double>& copy)
{
    copy.assign(field.begin(), field.end());
}

}  // namespace

LagError LagMeter::measure(coupling::SolidFields const& solid, coupling::Span<double const> velocity)
{
    LagError error;
    if (!void_fraction_.empty()) error = {force_change(solid, velocity), fraction_change(solid.void_fraction)};
    keep(solid.void_fraction, void_fraction_);
    keep(solid.drag_coefficient, coefficient_);
    keep(solid.drag_momentum, momentum_);
    return error;
}

double LagMeter::force_change(coupling::SolidFields const& solid, coupling::Span<double const> velocity) const
{
    double changed = 0, whole = 0;
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
    {
        auto const i = static_cast<std::size_t>(c);
        for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
        {
            double const v = velocity.empty() ? 0 : velocity[k];
            double const now = solid.drag_momentum[k] - solid.drag_coefficient[i] * v;
            double const before = momentum_[k] - coefficient_[i] * v;
            changed += mesh_.volume(c) * (now - before) * (now - before);
            whole += mesh_.volume(c) * now * now;
        }
    }
    return relative(changed, whole);
}

double LagMeter::fraction_change(coupling::Span<double const> void_fraction) const
{
    double changed = 0, whole = 0;
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
    {
        auto const i = static_cast<std::size_t>(c);
        double const change = void_fraction[i] - void_fraction_[i], solid = 1 - void_fraction[i];
        changed += mesh_.volume(c) * change * change;
        whole += mesh_.volume(c) * solid * solid;
    }
    return relative(changed, whole);
}

}  // namespace gimdem

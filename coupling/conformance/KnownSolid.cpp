// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/KnownSolid.hpp"

#include <cmath>
#include <utility>

namespace gimdem::conformance
{
namespace
{

/// 1 to 1.43; neighbours in any usual numbering differ.
double weight(std::size_t cell)
{
    return 1 + static_cast<double>(cell % 7) / 14;
}

}  // namespace

KnownSolid::KnownSolid(Law const& law, std::vector<double> volumes)
    : law_(law),
      volumes_(std::move(volumes)),
      void_fraction_(volumes_.size(), law.void_fraction),
      momentum_source_(3 * volumes_.size()),
      drag_coefficient_(volumes_.size()),
      drag_momentum_(3 * volumes_.size())
{
}

double KnownSolid::momentum(std::int64_t step, std::size_t cell, std::size_t axis) const
{
    return law_.momentum * law_.axis[axis] * (1 + static_cast<double>(step % 4) / 4) * weight(cell);
}

double KnownSolid::drag(std::size_t cell) const
{
    return law_.drag * weight(cell);
}

coupling::SolidFields KnownSolid::after(std::int64_t step, coupling::Span<double const> velocity)
{
    for (std::size_t cell = 0; cell < volumes_.size(); ++cell)
    {
        drag_coefficient_[cell] = drag(cell);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            std::size_t const i = 3 * cell + axis;
            drag_momentum_[i] = momentum(step, cell, axis);
            momentum_source_[i] = drag_momentum_[i] - drag(cell) * (velocity.empty() ? 0 : velocity[i]);
        }
    }
    return {void_fraction_, momentum_source_, drag_coefficient_, drag_momentum_};
}

std::array<double, 3> KnownSolid::force(std::int64_t step, std::vector<double> const& velocity) const
{
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < velocity.size(); ++i)
        sum[i % 3] += volumes_[i / 3] * (momentum(step, i / 3, i % 3) - drag(i / 3) * velocity[i]);
    return sum;
}

double KnownSolid::magnitude(std::int64_t step, std::vector<double> const& velocity) const
{
    double sum = 0;
    for (std::size_t i = 0; i < velocity.size(); ++i)
        sum += volumes_[i / 3] * (std::abs(momentum(step, i / 3, i % 3)) + std::abs(drag(i / 3) * velocity[i]));
    return sum;
}

}  // namespace gimdem::conformance

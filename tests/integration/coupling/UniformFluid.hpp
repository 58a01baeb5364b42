// SPDX-License-Identifier: BSD-3-Clause
/// A fluid that moves as one body: the fields that a scripted client sends.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::test
{

inline constexpr coupling::FluidProperties air{1.2, 1.8e-5};

class UniformFluid
{
public:
    UniformFluid(std::size_t cells, std::array<double, 3> velocity)
        : velocity_(3 * cells), zero_(9 * cells), cells_(cells)
    {
        for (std::size_t i = 0; i < 3 * cells; ++i)
            velocity_[i] = velocity[i % 3];
    }

    coupling::FluidFields view() const
    {
        coupling::FluidFields fields;
        fields.velocity = velocity_;
        fields.velocity_gradient = zero_;
        fields.pressure_gradient = {zero_.data(), 3 * cells_};
        fields.void_fraction_gradient = {zero_.data(), 3 * cells_};
        fields.pressure = {zero_.data(), cells_};
        return fields;
    }

    double velocity(std::size_t component) const { return velocity_[component]; }

private:
    std::vector<double> velocity_;  ///< [m/s]
    std::vector<double> zero_;
    std::size_t cells_;
};

}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
/// The solid that a mock server sends: nobody moves, and the force on the fluid is known.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::conformance
{

/// Uniform void fraction; in cell i after step n the force per volume on fluid of velocity v is
///
///   S = M - K v,   M = momentum * axis * (1 + (n mod 4) / 4) * weight(i),   K = drag * weight(i),
///
/// with weights between 1 and 1.5 that tell the cells apart; the factor of n tells the time levels apart.
class KnownSolid
{
public:
    struct Law
    {
        double void_fraction = 0.6;
        double drag = 100;                      ///< [kg/(m^3 s)]
        double momentum = 2;                    ///< [N/m^3]
        std::array<double, 3> axis{{0, 0, 1}};  ///< direction of M
    };

    KnownSolid(Law const& law, std::vector<double> volumes);

    /// After step n. velocity: of the fluid at its beginning, for momentum_source; empty: at rest. Spans live until the
    /// next call.
    coupling::SolidFields after(std::int64_t step, coupling::Span<double const> velocity);

    /// Sum over the cells of S V for the solid after step n on fluid of that velocity [N].
    std::array<double, 3> force(std::int64_t step, std::vector<double> const& velocity) const;
    /// Sum of the magnitudes of its parts [N]: what a deviation is small against.
    double magnitude(std::int64_t step, std::vector<double> const& velocity) const;

private:
    double momentum(std::int64_t step, std::size_t cell, std::size_t axis) const;
    double drag(std::size_t cell) const;

    Law law_;
    std::vector<double> volumes_;
    std::vector<double> void_fraction_, momentum_source_, drag_coefficient_, drag_momentum_;
};

}  // namespace gimdem::conformance

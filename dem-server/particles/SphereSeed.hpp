// SPDX-License-Identifier: BSD-3-Clause
/// Spheres that are about to become particles.
#pragma once

#include <vector>

#include "particles/ParticleState.hpp"

namespace gimdem
{

/// A sphere to be.
struct SphereSeed
{
    Vec3 position;  ///< [m]
    double radius;  ///< [m]
    Vec3 velocity;  ///< [m/s]
};

/// Adds particles of one material at the end, with ids from `first_id` on. density [kg/m^3].
void append(std::vector<SphereSeed> const& seeds, int material, double density, std::int64_t first_id,
            ParticleState& particles);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Particles as a ParaView file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace gimdem::output
{

/// The particles at one time, by reference. An array that is empty is left out of the file, except position.
struct ParticleFrame
{
    double time = 0;                           ///< [s]
    std::span<double const> position;          ///< shape=(n, 3), row-major [m]
    std::span<double const> radius;            ///< shape=(n,) [m]
    std::span<double const> velocity;          ///< shape=(n, 3), row-major [m/s]
    std::span<double const> angular_velocity;  ///< shape=(n, 3), row-major [rad/s]
    std::span<std::int64_t const> id;          ///< shape=(n,)
};

/// Write `frame` as VTK PolyData (.vtp): one vertex per particle, reals as Float32, compressed.
///
/// The file appears whole or not at all. Throws UserError with the path and the system's reason.
void write_vtk_particles(std::filesystem::path const& file, ParticleFrame const& frame);

}  // namespace gimdem::output

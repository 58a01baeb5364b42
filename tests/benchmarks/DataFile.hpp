// SPDX-License-Identifier: BSD-3-Clause
/// States of particles as data files of LAMMPS (id type diameter density x y z, then Velocities), so that other
/// programs start from the same ones.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "TestCase.hpp"

namespace gimdem::benchmark
{

/// Sections "Atoms" and "Velocities" of a data file; throws std::runtime_error for anything that cannot be read.
std::vector<test::Sphere> read_data(std::string const& path);

/// By rising id, as read_data() reads it; `box`: its sides [m], from the origin.
void write_data(std::string const& path, ParticleState const& particles, std::array<double, 3> const& box);

}  // namespace gimdem::benchmark

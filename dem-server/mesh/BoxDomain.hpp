// SPDX-License-Identifier: BSD-3-Clause
/// The box of a run without a fluid, as a mesh of one cell: what bounds the particles has one form everywhere.
#pragma once

#include <array>

#include "core/Case.hpp"
#include "gimdem/coupling/Types.hpp"

namespace gimdem
{

/// The sides in the order in which code counts them.
inline constexpr std::array<char const*, 6> side_names{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

bool is_open(DomainSettings const& domain, std::size_t side);

/// One cell with a patch for each side: kind open for those that [domain] names, cyclic (no wall) along
/// periodic axes, where the cell is longer by half a period at both ends, wall for the others.
coupling::Mesh box_mesh(DomainSettings const& domain);

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// An order of all cells in which cells near to each other follow each other: what a kernel reads of the cells around
/// one is then still in the cache for the next.
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// By Morton's curve through the centroids.
exec::Buffer<std::int32_t> spatial_order(PolyMesh const& mesh);

}  // namespace gimdem

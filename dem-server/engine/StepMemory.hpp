// SPDX-License-Identifier: BSD-3-Clause
/// The particle side at the beginning of a coupling step: what CoupledEngine::remember() keeps.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/DemMemory.hpp"
#include "mapping/WeightReuse.hpp"
#include "particles/Inlet.hpp"

namespace gimdem
{

struct StepMemory
{
    DemMemory dem;
    exec::Buffer<std::int32_t> cell_of;  ///< of the fluid's mesh, where each particle was found last
    exec::Buffer<double> void_fraction;  ///< that the drag is computed with
    WeightReference reference;           ///< where weights are reused
    std::vector<InletState> inlets;
    std::int64_t clips = 0;  ///< CoupledEngine::particle_clips()
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// All of a DemSystem that changes from step to step, in memory: what DemSystem::remember() keeps and go_back() puts
/// back, to the bit. Unlike a checkpoint it has the neighbour list too, so that going back builds none.
#pragma once

#include <cstdint>

#include "engine/DemSystem.hpp"

namespace gimdem
{

struct DemMemory
{
    ParticleState particles;
    NeighborList neighbors;
    WallContacts::Memory walls;
    exec::Buffer<Impulse> impulses;
    std::int64_t next_id = 0, rebuilds = 0;
    RemovedByCause removed;
};

}  // namespace gimdem

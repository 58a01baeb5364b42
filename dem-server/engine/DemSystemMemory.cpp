// SPDX-License-Identifier: BSD-3-Clause
/// To go back by a coupling step, theory.md (C.15).
#include "engine/DemMemory.hpp"
#include "engine/DemSystem.hpp"

namespace gimdem
{

// A state that is on a device goes there anew: so the pass that follows begins as those after go_back() do, and each
// of them comes to the same bits.
void DemSystem::remember(DemMemory& memory)
{
    to_change();
    memory.particles = particles_;
    memory.neighbors = neighbors_;
    memory.walls = wall_contacts_.memory();
    memory.impulses = impulses_;
    memory.next_id = next_id_;
    memory.rebuilds = rebuilds_;
    memory.removed = removed_;
}

void DemSystem::go_back(DemMemory const& memory)
{
    host_is_old_ = false;
    device_is_old_ = true;
    particles_ = memory.particles;
    neighbors_ = memory.neighbors;
    wall_contacts_.go_back(memory.walls);
    impulses_ = memory.impulses;
    next_id_ = memory.next_id;
    rebuilds_ = memory.rebuilds;
    removed_ = memory.removed;
    particle_contacts_.set_one_size(have_one_size(particles_));
}

}  // namespace gimdem

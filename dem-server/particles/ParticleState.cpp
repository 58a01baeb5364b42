// SPDX-License-Identifier: BSD-3-Clause
#include "particles/ParticleState.hpp"

namespace gimdem
{

ParticleView ParticleState::view()
{
    return {position.view().data, velocity.view().data, angular_velocity.view().data,      force.view().data,
            torque.view().data,   material.view().data, static_cast<std::int64_t>(count())};
}

void ParticleState::resize(std::int64_t count)
{
    position.resize(count);
    velocity.resize(count);
    angular_velocity.resize(count);
    force.resize(count);
    torque.resize(count);
    material.resize(count);
    id.resize(count);
}

void ParticleState::permute(exec::Execution const& execution, std::span<std::int32_t const> order)
{
    for (exec::Buffer<Quad>* const values : {&position, &velocity, &angular_velocity})
        gimdem::permute(execution, *values, order, force);
    gimdem::permute(execution, material, order, torque);
    gimdem::permute(execution, id, order, torque);
    force.resize(count());
}

double ParticleState::volume(std::int64_t i) const
{
    return sphere_volume(position[i].w);
}

double ParticleState::mass(std::int64_t i) const
{
    return 1 / velocity[i].w;
}

}  // namespace gimdem

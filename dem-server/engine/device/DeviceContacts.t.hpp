// SPDX-License-Identifier: BSD-3-Clause
/// Body of DeviceContacts, for the files that instantiate it.
#pragma once

#include "engine/device/DeviceContacts.hpp"

namespace gimdem
{

template <class Device>
template <class Real>
void DeviceContacts<Device>::find_forces(DeviceLaws<Device> const& laws, DeviceParticles<Device> const& particles,
                                         DeviceNeighbors<Device> const& neighbors, double dt, Records<Real>& pair_force)
{
    pair_force.resize(device_, neighbors.pair_count());
    laws.template visit<Real>(
        [&]<class Law>(typename Law::template Constants<Real> const* constants)
        {
            rolling_torque_.resize(device_, Law::rolls ? neighbors.pair_count() : 0);
            in_space_of(domain_,
                        [&]<class Space>(Space space)
                        {
                            PairForceKernel<Law, Space, Real> const kernel{
                                particles.view(),  neighbors.view(),      constants, laws.material_count(), dt, space,
                                pair_force.data(), rolling_torque_.data()};
                            device_.for_each(neighbors.pair_count(), Unless{neighbors.stale(), kernel});
                        });
        });
}

template <class Device>
template <class Real>
void DeviceContacts<Device>::sum_forces(DeviceParticles<Device> const& particles,
                                        DeviceNeighbors<Device> const& neighbors, WallForcesView const& walls,
                                        Records<Real> const& pair_force)
{
    ContactSumKernel<Real, WallForcesView> const kernel{particles.view(), neighbors.view(), pair_force.data(),
                                                        rolling_torque_.data(), walls};
    device_.for_each(particles.count(), Unless{neighbors.stale(), kernel});
}

template <class Device>
void DeviceContacts<Device>::find_forces(DeviceLaws<Device> const& laws, DeviceParticles<Device> const& particles,
                                         DeviceNeighbors<Device> const& neighbors, double dt)
{
    if (is_single_)
        find_forces(laws, particles, neighbors, dt, pair_force_single_);
    else
        find_forces(laws, particles, neighbors, dt, pair_force_);
}

template <class Device>
void DeviceContacts<Device>::sum_forces(DeviceParticles<Device> const& particles,
                                        DeviceNeighbors<Device> const& neighbors, WallForcesView const& walls)
{
    if (is_single_)
        sum_forces(particles, neighbors, walls, pair_force_single_);
    else
        sum_forces(particles, neighbors, walls, pair_force_);
}

}  // namespace gimdem

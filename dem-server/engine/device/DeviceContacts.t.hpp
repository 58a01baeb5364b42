// SPDX-License-Identifier: BSD-3-Clause
/// Body of DeviceContacts, for the files that instantiate it.
#pragma once

#include "engine/device/DeviceContacts.hpp"

namespace gimdem
{

template <class Device>
void DeviceContacts<Device>::find_forces(DeviceLaws<Device> const& laws, DeviceParticles<Device> const& particles,
                                         DeviceNeighbors<Device> const& neighbors, double dt)
{
    pair_force_.resize(device_, neighbors.pair_count());
    laws.visit(
        [&]<class Law>(typename Law::template Constants<double> const* constants)
        {
            rolling_torque_.resize(device_, Law::rolls ? neighbors.pair_count() : 0);
            in_space_of(domain_,
                        [&]<class Space>(Space space)
                        {
                            device_.for_each(
                                neighbors.pair_count(),
                                Unless{neighbors.stale(),
                                       PairForceKernel<Law, Space>{particles.view(), neighbors.view(), constants,
                                                                   laws.material_count(), dt, space, pair_force_.data(),
                                                                   rolling_torque_.data()}});
                        });
        });
}

template <class Device>
void DeviceContacts<Device>::sum_forces(DeviceParticles<Device> const& particles,
                                        DeviceNeighbors<Device> const& neighbors, WallForcesView const& walls)
{
    device_.for_each(
        particles.count(),
        Unless{neighbors.stale(), ContactSumKernel<WallForcesView>{particles.view(), neighbors.view(),
                                                                   pair_force_.data(), rolling_torque_.data(), walls}});
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles on a device.
#pragma once

#include <cstdint>

#include "contact/ContactModel.hpp"
#include "engine/device/DeviceNeighbors.hpp"
#include "walls/PairwiseWallKernel.hpp"

namespace gimdem
{

/// The constants of a scene's laws in the memory of a device.
template <class Device>
class DeviceLaws
{
public:
    DeviceLaws(Device& device, Materials const& materials) : model_(materials), material_count_(materials.count())
    {
        model_.visit(
            [&]<class Law>(LawTable<Law> const& table)
            {
                auto const bytes = std::as_bytes(table.constants.host());
                constants_.upload(device,
                                  {reinterpret_cast<double const*>(bytes.data()), bytes.size() / sizeof(double)});
            });
    }

    bool has_rolling_spring() const { return model_.has_rolling_spring(); }
    std::int32_t material_count() const { return material_count_; }

    /// Calls work.template operator()<Law>(constants) with the scene's laws and where their constants are.
    template <class Work>
    void visit(Work const& work) const
    {
        model_.visit(
            [&]<class Law>(LawTable<Law> const&)
            {
                work.template operator()<Law>(
                    reinterpret_cast<typename Law::template Constants<double> const*>(constants_.data()));
            });
    }

private:
    ContactModel model_;
    std::int32_t material_count_;
    exec::DeviceArray<Device, double> constants_;
};

/// Its functions are instantiated in a file of its own: they hold a kernel for every choice of laws.
template <class Device>
class DeviceContacts
{
public:
    DeviceContacts(Device& device, Domain const& domain) : device_(device), domain_(domain) {}

    /// Finds the force of every pair; advances the springs by dt [s]. Nothing happens where the list is stale.
    void find_forces(DeviceLaws<Device> const& laws, DeviceParticles<Device> const& particles,
                     DeviceNeighbors<Device> const& neighbors, double dt);
    /// Sets force and torque of every particle to the sum over its contacts, unless the list is stale.
    void sum_forces(DeviceParticles<Device> const& particles, DeviceNeighbors<Device> const& neighbors,
                    WallForcesView const& walls);

private:
    Device& device_;
    Domain domain_;
    exec::DeviceArray<Device, PairForce> pair_force_;
    exec::DeviceArray<Device, Quad> rolling_torque_;
};

}  // namespace gimdem

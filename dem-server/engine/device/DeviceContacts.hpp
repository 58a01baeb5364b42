// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles on a device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

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
                std::span const numbers(reinterpret_cast<double const*>(bytes.data()), bytes.size() / sizeof(double));
                constants_.upload(device, numbers);
                singles_here_.assign(numbers.begin(), numbers.end());
                singles_.upload(device, std::span<exec::Single const>(singles_here_));
            });
    }

    bool has_rolling_spring() const { return model_.has_rolling_spring(); }
    std::int32_t material_count() const { return material_count_; }

    /// Calls work.template operator()<Law>(constants) with the scene's laws and where their constants are. Real: double
    /// or exec::Single.
    template <class Real, class Work>
    void visit(Work const& work) const
    {
        model_.visit(
            [&]<class Law>(LawTable<Law> const&)
            {
                using Constants = typename Law::template Constants<Real>;
                if constexpr (exec::is_single<Real>)
                    work.template operator()<Law>(reinterpret_cast<Constants const*>(singles_.data()));
                else
                    work.template operator()<Law>(reinterpret_cast<Constants const*>(constants_.data()));
            });
    }

private:
    ContactModel model_;
    std::int32_t material_count_;
    std::vector<exec::Single> singles_here_;
    exec::DeviceArray<Device, double> constants_;
    exec::DeviceArray<Device, exec::Single> singles_;  ///< the same in single precision
};

/// Its functions are instantiated in a file of its own: they hold a kernel for every choice of laws.
template <class Device>
class DeviceContacts
{
public:
    /// `single`: the laws are computed in single precision.
    DeviceContacts(Device& device, Domain const& domain, bool single)
        : device_(device), domain_(domain), is_single_(single)
    {
    }

    /// Finds the force of every pair; advances the springs by dt [s]. Nothing happens where the list is stale.
    void find_forces(DeviceLaws<Device> const& laws, DeviceParticles<Device> const& particles,
                     DeviceNeighbors<Device> const& neighbors, double dt);
    /// Sets force and torque of every particle to the sum over its contacts, unless the list is stale.
    void sum_forces(DeviceParticles<Device> const& particles, DeviceNeighbors<Device> const& neighbors,
                    WallForcesView const& walls);

private:
    template <class Real>
    using Records = exec::DeviceArray<Device, PairForce<Real>>;

    template <class Real>
    void find_forces(DeviceLaws<Device> const& laws, DeviceParticles<Device> const& particles,
                     DeviceNeighbors<Device> const& neighbors, double dt, Records<Real>& pair_force);
    template <class Real>
    void sum_forces(DeviceParticles<Device> const& particles, DeviceNeighbors<Device> const& neighbors,
                    WallForcesView const& walls, Records<Real> const& pair_force);

    Device& device_;
    Domain domain_;
    bool is_single_;
    Records<double> pair_force_;
    Records<exec::Single> pair_force_single_;
    exec::DeviceArray<Device, Quad> rolling_torque_;
};

}  // namespace gimdem

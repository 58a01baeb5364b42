// SPDX-License-Identifier: BSD-3-Clause
/// The particles in the memory of a device.
#pragma once

#include <cstdint>

#include "exec/device/DeviceArray.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// to[i] = from[order[i]].
template <class T>
struct Gather
{
    T const* from;
    std::int32_t const* order;
    T* to;

    GIMDEM_HD void operator()(std::int64_t i) const { to[i] = from[order[i]]; }
};

/// Permutes arrays of one type; keeps the array that it permutes into.
template <class Device, class T>
class DevicePermute
{
public:
    void operator()(Device& device, exec::DeviceArray<Device, T>& values, std::int32_t const* order)
    {
        permuted_.resize(device, values.size());
        device.for_each(values.size(), Gather<T>{values.data(), order, permuted_.data()});
        swap(values, permuted_);
    }

private:
    exec::DeviceArray<Device, T> permuted_;
};

/// The arrays of ParticleState, and what else belongs to a particle.
template <class Device>
class DeviceParticles
{
public:
    template <class T>
    using Array = exec::DeviceArray<Device, T>;

    Array<Quad> position, velocity, angular_velocity, force, torque;
    Array<std::int32_t> material;
    Array<std::int64_t> id;
    Array<Impulse> impulses;      ///< empty without a fluid
    Array<std::int32_t> cell_of;  ///< of the fluid's mesh; empty until particles are located

    std::int64_t count() const { return position.size(); }
    ParticleView view() const
    {
        return {position.data(), velocity.data(), angular_velocity.data(), force.data(), torque.data(),
                material.data(), count()};
    }

    void upload(Device& device, ParticleState const& from, exec::Buffer<Impulse> const& impulses_of)
    {
        if (from.count() != count()) cell_of.resize(device, 0);
        position.upload(device, from.position);
        velocity.upload(device, from.velocity);
        angular_velocity.upload(device, from.angular_velocity);
        force.upload(device, from.force);
        torque.upload(device, from.torque);
        material.upload(device, from.material);
        id.upload(device, from.id);
        impulses.upload(device, impulses_of);
    }

    /// The host may look after wait().
    void download(Device& device, ParticleState& to, exec::Buffer<Impulse>& impulses_of) const
    {
        position.download(device, to.position);
        velocity.download(device, to.velocity);
        angular_velocity.download(device, to.angular_velocity);
        force.download(device, to.force);
        torque.download(device, to.torque);
        material.download(device, to.material);
        id.download(device, to.id);
        impulses.download(device, impulses_of);
    }

    /// Put the particle that was at order[i] at i. Forces are to be computed anew.
    void permute(Device& device, std::int32_t const* order)
    {
        permute_quads_(device, position, order);
        permute_quads_(device, velocity, order);
        permute_quads_(device, angular_velocity, order);
        permute_numbers_(device, material, order);
        permute_ids_(device, id, order);
        if (impulses.size() > 0) permute_impulses_(device, impulses, order);
        if (cell_of.size() == count()) permute_numbers_(device, cell_of, order);
    }

private:
    DevicePermute<Device, Quad> permute_quads_;
    DevicePermute<Device, std::int32_t> permute_numbers_;
    DevicePermute<Device, std::int64_t> permute_ids_;
    DevicePermute<Device, Impulse> permute_impulses_;
};

}  // namespace gimdem

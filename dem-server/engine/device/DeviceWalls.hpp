// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles and walls on a device: the same lists as WallContacts makes, by the same kernels.
#pragma once

#include <cstdint>

#include "engine/device/DeviceContacts.hpp"
#include "walls/WallContacts.hpp"
#include "walls/WallListKernels.hpp"

namespace gimdem
{

/// The walls' geometry in the memory of a device.
template <class Device>
class DeviceWallGeometry
{
public:
    DeviceWallGeometry(Device& device, WallGeometry const& from);

    void take_poses(Device& device, WallContacts const& walls) { poses_.upload(device, walls.poses()); }
    NearbyWalls view() const
    {
        return {{surfaces_.data(), triangles_.data(), bodies_.data(), static_cast<std::int32_t>(bodies_.size()),
                 grid_offsets_.data(), grid_triangles_.data()},
                poses_.data()};
    }

private:
    exec::DeviceArray<Device, WallSurface> surfaces_;
    exec::DeviceArray<Device, WallTriangle> triangles_;
    exec::DeviceArray<Device, WallBody> bodies_;
    exec::DeviceArray<Device, std::int32_t> grid_offsets_, grid_triangles_;
    exec::DeviceArray<Device, WallPose> poses_;
};

template <class Device>
class DeviceWalls
{
public:
    template <class T>
    using Array = exec::DeviceArray<Device, T>;

    /// `walls` knows where they stand; it outlives this.
    DeviceWalls(Device& device, WallGeometry const& geometry, WallContacts& walls, bool has_rolling_spring);

    void upload(WallPairs const& pairs, std::int64_t particle_count);
    /// The host may look after wait().
    void download(WallPairs& pairs);

    bool is_stale(double skin) const { return walls_.is_stale(skin); }

    /// Lists the pairs closer than radius + skin [m]; the springs move along with `order`.
    void build(DeviceParticles<Device> const& particles, double skin, std::int32_t const* order);

    /// Finds the walls' forces, beside whatever else the device does; advances the springs by dt [s]. Nothing happens
    /// where the flag `stale` is raised. In a file of its own, like DeviceContacts.
    void find_forces(DeviceLaws<Device> const& laws, DeviceParticles<Device> const& particles,
                     std::int32_t const* stale, double dt);
    WallForcesView forces() const { return {near_places_.data(), force_.data()}; }

    // Time integral of the walls' force [N s], computed beside whatever else the device does: over the half step owed
    // to the step before, if any, then over h [s].
    void clear_impulse(std::int64_t particle_count);
    void add_impulse(double owed, double h);
    Vec3 impulse();

private:
    void find_near(std::int64_t particle_count);
    void carry_springs(Array<Quad> const& old_spring, Array<Quad>& spring, std::int32_t const* order);

    Device& device_;
    WallContacts& walls_;
    DeviceWallGeometry<Device> geometry_;
    bool has_rolling_spring_;
    bool has_springs_ = false;
    bool force_is_hosts_ = true;         ///< no force was computed here since the state came from the host
    Vec3 hosts_impulse_ = Vec3::Zero();  ///< of such forces [N s]
    Array<std::int32_t> first_pair_, offsets_, plane_, old_offsets_, old_plane_, near_, near_places_;
    Array<std::uint8_t> whole_;
    Array<std::uint64_t> seen_;
    Array<Quad> displacement_, rolling_spring_, old_displacement_, old_rolling_spring_, impulse_;
    Array<WallForce> force_;
    Array<Touch> touches_;
    exec::DeviceScan<Device> scan_;
    exec::DeviceReduce<Device, std::int32_t> highest_;
    exec::DeviceReduce<Device, Quad> sum_;
    exec::DeviceScalar<Device, std::int32_t> number_;
};

}  // namespace gimdem

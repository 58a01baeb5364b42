// SPDX-License-Identifier: BSD-3-Clause
/// Body of DeviceWalls, for the files that instantiate it.
#pragma once

#include <algorithm>

#include "engine/device/DeviceWalls.hpp"
#include "engine/device/Reductions.hpp"
#include "walls/PairwiseWallKernel.hpp"

namespace gimdem
{

/// 1 for a particle that has pairs.
struct HasPairs
{
    std::int32_t const* offsets;
    std::int32_t* flags;

    GIMDEM_HD void operator()(std::int64_t i) const { flags[i] = offsets[i] != offsets[i + 1] ? 1 : 0; }
};

/// Lists the particles that have pairs, rising.
struct ListNear
{
    std::int32_t const* places;
    std::int32_t* near;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        if (places[i] != places[i + 1]) near[places[i]] = static_cast<std::int32_t>(i);
    }
};

struct WallForceOf
{
    WallForce const* forces;

    GIMDEM_HD Quad operator()(std::int64_t n) const { return forces[n].force; }
};

struct WallImpulseKernel
{
    std::int32_t const* near;
    WallForce const* forces;
    double owed, h;
    Quad* impulse;

    GIMDEM_HD void operator()(std::int64_t n) const
    {
        Quad sum = impulse[near[n]];
        Quad const force = forces[n].force;
        if (owed > 0) sum = sum + owed * force;
        impulse[near[n]] = sum + h * force;
    }
};

template <class Device>
DeviceWallGeometry<Device>::DeviceWallGeometry(Device& device, WallGeometry const& from)
{
    WallView const walls = from.view();
    auto const bodies = static_cast<std::size_t>(walls.body_count);
    surfaces_.upload(device, {walls.surfaces, static_cast<std::size_t>(from.plane_count())});
    triangles_.upload(device, {walls.triangles, static_cast<std::size_t>(from.triangle_count())});
    bodies_.upload(device, {walls.bodies, bodies});
    std::int64_t offsets = 0, entries = 0;
    for (std::size_t b = 0; b < bodies; ++b)
        if (walls.bodies[b].has_triangles)
            offsets = std::max(offsets, walls.bodies[b].grid_begin + walls.bodies[b].grid.count() + 1);
    for (std::int64_t k = 0; k < offsets; ++k)
        entries = std::max<std::int64_t>(entries, walls.grid_offsets[k]);
    grid_offsets_.upload(device, {walls.grid_offsets, static_cast<std::size_t>(offsets)});
    grid_triangles_.upload(device, {walls.grid_triangles, static_cast<std::size_t>(entries)});
}

template <class Device>
DeviceWalls<Device>::DeviceWalls(Device& device, WallGeometry const& geometry, WallContacts& walls,
                                 bool has_rolling_spring)
    : device_(device),
      walls_(walls),
      geometry_(device, geometry),
      has_rolling_spring_(has_rolling_spring),
      highest_(device),
      sum_(device),
      number_(device)
{
    first_pair_.upload(device, walls.first_pairs());
    geometry_.take_poses(device_, walls_);
    device.wait();
}

template <class Device>
void DeviceWalls<Device>::upload(WallPairs const& pairs, std::int64_t particle_count)
{
    has_springs_ = pairs.offsets.size() == particle_count + 1;
    near_.resize(device_, 0);
    if (has_springs_)
    {
        offsets_.upload(device_, pairs.offsets);
        plane_.upload(device_, pairs.plane);
        whole_.upload(device_, pairs.whole);
        displacement_.upload(device_, pairs.displacement);
        if (has_rolling_spring_) rolling_spring_.upload(device_, pairs.rolling_spring);
        if (pairs.whole.size() == pairs.plane.size()) find_near(particle_count);
    }
    force_.resize(device_, near_.size());
    force_is_hosts_ = true;
    if (impulse_.size() != particle_count) clear_impulse(particle_count);
}

template <class Device>
void DeviceWalls<Device>::download(WallPairs& pairs)
{
    if (!force_is_hosts_) walls_.set_total_force(sum_(force_.size(), WallForceOf{force_.data()}, Add<Quad>{}).xyz());
    offsets_.download(device_, pairs.offsets);
    plane_.download(device_, pairs.plane);
    whole_.download(device_, pairs.whole);
    displacement_.download(device_, pairs.displacement);
    if (has_rolling_spring_) rolling_spring_.download(device_, pairs.rolling_spring);
}

template <class Device>
void DeviceWalls<Device>::build(DeviceParticles<Device> const& particles, double skin, std::int32_t const* order)
{
    std::int64_t const n = particles.count();
    swap(old_offsets_, offsets_);
    swap(old_plane_, plane_);
    swap(old_displacement_, displacement_);
    swap(old_rolling_spring_, rolling_spring_);

    geometry_.take_poses(device_, walls_);
    offsets_.resize(device_, n + 1);
    seen_.resize(device_, n);
    PairLister lister{geometry_.view(), particles.position.data(), skin, offsets_.data(), seen_.data(), nullptr,
                      nullptr};
    device_.for_each(n, lister);
    std::int32_t const most = highest_(n, EntryOf<std::int32_t>{offsets_.data()}, Highest{});
    scan_(device_, offsets_.view());
    std::int32_t const count = number_.read(offsets_.data() + n);
    plane_.resize(device_, count);
    whole_.resize(device_, count);
    displacement_.resize(device_, count);
    rolling_spring_.resize(device_, has_rolling_spring_ ? count : 0);
    touches_.resize(device_, most > WallTouches::most_at_hand ? count : 0);
    lister.plane = plane_.data();
    lister.whole = whole_.data();
    if (count > 0) device_.for_each(n, lister);

    carry_springs(old_displacement_, displacement_, order);
    if (has_rolling_spring_) carry_springs(old_rolling_spring_, rolling_spring_, order);
    has_springs_ = true;
    find_near(n);
    force_.resize(device_, near_.size());
}

template <class Device>
void DeviceWalls<Device>::carry_springs(Array<Quad> const& old_spring, Array<Quad>& spring, std::int32_t const* order)
{
    if (has_springs_ && spring.size() > 0)
        device_.for_each(offsets_.size() - 1,
                         WallSpringCarrier{order, offsets_.data(), plane_.data(), old_offsets_.data(),
                                           old_plane_.data(), old_spring.data(), spring.data()});
    else
        spring.zero(device_);
}

template <class Device>
void DeviceWalls<Device>::find_near(std::int64_t particle_count)
{
    near_places_.resize(device_, particle_count + 1);
    device_.for_each(particle_count, HasPairs{offsets_.data(), near_places_.data()});
    scan_(device_, near_places_.view());
    near_.resize(device_, number_.read(near_places_.data() + particle_count));
    if (near_.size() > 0) device_.for_each(particle_count, ListNear{near_places_.data(), near_.data()});
}

template <class Device>
void DeviceWalls<Device>::find_forces(DeviceLaws<Device> const& laws, DeviceParticles<Device> const& particles,
                                      std::int32_t const* stale, double dt)
{
    if (walls_.some_move()) geometry_.take_poses(device_, walls_);
    ParticleWallFinder const find{{geometry_.view(), plane_.data(), whole_.data()},
                                  {displacement_.data(), rolling_spring_.data()},
                                  particles.position.data(),
                                  offsets_.data(),
                                  touches_.data()};
    force_is_hosts_ = false;
    laws.template visit<double>(
        [&]<class Law>(typename Law::template Constants<double> const* constants)
        {
            device_.for_each_beside(
                near_.size(), Unless{stale, ParticleWallKernel<Law>{particles.view(), find, near_.data(), constants,
                                                                    first_pair_.data(), dt, force_.data()}});
        });
}

template <class Device>
void DeviceWalls<Device>::clear_impulse(std::int64_t particle_count)
{
    impulse_.resize(device_, particle_count);
    impulse_.zero(device_);
    hosts_impulse_.setZero();
}

template <class Device>
void DeviceWalls<Device>::add_impulse(double owed, double h)
{
    if (force_is_hosts_)
        hosts_impulse_ += h * walls_.total_force();  // of a state that has just come from the host: it owes nothing
    else
        device_.for_each_beside(near_.size(), WallImpulseKernel{near_.data(), force_.data(), owed, h, impulse_.data()});
}

template <class Device>
Vec3 DeviceWalls<Device>::impulse()
{
    return hosts_impulse_ + sum_(impulse_.size(), EntryOf<Quad>{impulse_.data()}, Add<Quad>{}).xyz();
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Body of DeviceFluid, for the files that instantiate it.
#pragma once

#include <algorithm>

#include "engine/device/DeviceFluid.hpp"
#include "engine/device/DeviceMapping.t.hpp"
#include "engine/device/DeviceNeighbors.hpp"
#include "engine/device/Reductions.hpp"

namespace gimdem
{

struct SteadyForceOf
{
    FluidLoad const* loads;
    GIMDEM_HD Quad operator()(std::int64_t p) const { return loads[p].steady; }
};

struct ImpulseOf
{
    Impulse const* impulses;
    Quad const* position;

    GIMDEM_HD ImpulseSums operator()(std::int64_t p) const
    {
        Quad const drag = impulses[p].drag;
        return {drag, drag.xyz().norm(), sphere_volume(position[p].w)};
    }
};

/// Which groups have a member.
struct OccupiedKernel
{
    std::int32_t const* offsets;  ///< shape=(n_cells + 1,)
    std::uint8_t* flags;

    GIMDEM_HD void operator()(std::int64_t c) const { flags[c] = offsets[c + 1] > offsets[c] ? 1 : 0; }
};

template <class Device>
void DeviceMesh<Device>::upload(Device& device, FluidScene const& scene)
{
    MeshKernelView const from = scene.mesh.view();
    auto const cells = static_cast<std::size_t>(scene.mesh.cell_count());
    auto const faces = static_cast<std::size_t>(scene.mesh.face_count());
    internal_faces_ = from.internal_face_count;
    cells_.upload(device, {from.cell, cells});
    face_centres_.upload(device, {from.face_centre, faces});
    face_normals_.upload(device, {from.face_normal, faces});
    owner_.upload(device, {from.owner, faces});
    neighbour_.upload(device, {from.neighbour, static_cast<std::size_t>(internal_faces_)});
    offsets_.upload(device, {from.cell_offsets, cells + 1});
    cell_faces_.upload(device, {from.cell_faces, static_cast<std::size_t>(from.cell_offsets[cells])});
    coupling::Mesh const& topology = scene.mesh.topology();
    points_.upload(device, {topology.points.data(), topology.points.size()});
    face_offsets_.upload(device, {topology.face_offsets.data(), topology.face_offsets.size()});
    face_points_.upload(device, {topology.face_points.data(), topology.face_points.size()});
    BoxGrid const& grid = scene.mapper.cell_grid();
    boxes_.upload(device, grid.boxes());
    bin_offsets_.upload(device, grid.offsets());
    bin_members_.upload(device, grid.members());
    bin_nearest_.upload(device, grid.nearest());
    wall_faces_.upload(device, scene.wall_faces);
    device.wait();
}

template <class Device>
DeviceFluid<Device>::~DeviceFluid()
{
    if (kept_ == nullptr) return;
    device_.free_pinned(quads_here_);
    device_.free_pinned(numbers_here_);
    device_.free_pinned(sums_here_);
}

template <class Device>
void DeviceFluid<Device>::set_scene(FluidScene const& scene)
{
    kept_ = std::make_unique<FluidScene>(scene);
    scene_ = kept_.get();
    mesh_.upload(device_, scene);
    auto const n = static_cast<std::size_t>(scene.mesh.cell_count());
    quads_here_ = static_cast<Quad*>(device_.allocate_pinned(3 * n * sizeof(Quad)));
    numbers_here_ = static_cast<double*>(device_.allocate_pinned(9 * n * sizeof(double)));
    sums_here_ = static_cast<Share*>(device_.allocate_pinned(n * sizeof(Share)));
    exec::Buffer<double> empty(scene.mesh.cell_count());
    empty.fill(1);
    set_void_fraction(empty);
    device_.wait();
}

template <class Device>
void DeviceFluid<Device>::take_sizes(ParticleState const& particles)
{
    if (scene_ != nullptr) mapping_.upload(device_, *scene_, mesh_.view(), mesh_.boxes(), particles);
}

template <class Device>
void DeviceFluid<Device>::stage(coupling::Span<double const> from, Quad* to) const
{
    auto const n = static_cast<std::size_t>(mesh_.cell_count());
    for (std::size_t c = 0; c < n; ++c)
        to[c] = from.empty() ? Quad{0, 0, 0, 0} : Quad{from[3 * c], from[3 * c + 1], from[3 * c + 2], 0};
}

template <class Device>
void DeviceFluid<Device>::load(coupling::FluidFields const& fields)
{
    auto const n = static_cast<std::size_t>(mesh_.cell_count());
    device_.wait();  // until the last fields have left the pinned memory
    stage(fields.velocity, quads_here_);
    stage(fields.pressure_gradient, quads_here_ + n);
    stage(fields.void_fraction_gradient, quads_here_ + 2 * n);
    if (fields.velocity_gradient.empty())
        std::fill_n(numbers_here_, 9 * n, 0.0);
    else
        std::copy(fields.velocity_gradient.begin(), fields.velocity_gradient.end(), numbers_here_);
    velocity_.upload(device_, {quads_here_, n});
    pressure_gradient_.upload(device_, {quads_here_ + n, n});
    void_gradient_.upload(device_, {quads_here_ + 2 * n, n});
    velocity_gradient_.upload(device_, {numbers_here_, 9 * n});
}

template <class Device>
void DeviceFluid<Device>::apply(DeviceParticles<Device>& particles)
{
    std::int64_t const n = particles.count();
    if (particles.cell_of.size() != n) static_cast<void>(locate(particles));  // some came or went
    loads_.resize(device_, n);
    if (clips_.size() != n)
    {
        clips_before_ = clipped();
        clips_.resize(device_, n);
        clips_.zero(device_);
    }
    FluidForceSettings const& settings = scene_->settings.fluid_forces;
    FluidView const fluid{velocity_.data(),      velocity_gradient_.data(), pressure_gradient_.data(),
                          void_gradient_.data(), scene_->fluid.density,     scene_->fluid.viscosity};
    device_.for_each(n, ParticleLoadKernel{particles.position.data(), particles.velocity.data(),
                                           particles.cell_of.data(), mesh_.cells(), void_fraction_.data(), fluid,
                                           scene_->settings.mapping.void_fraction_minimum, settings.drag != "none",
                                           settings.pressure_gradient, loads_.data(), clips_.data()});
}

template <class Device>
Vec3 DeviceFluid<Device>::steady_force()
{
    return sum_quads_(loads_.size(), SteadyForceOf{loads_.data()}, Add<Quad>{}).xyz();
}

template <class Device>
std::int64_t DeviceFluid<Device>::clipped()
{
    return clips_before_ +
           sum_counts_(clips_.size(), EntryOf<std::int64_t, std::int32_t>{clips_.data()}, Add<std::int64_t>{});
}

template <class Device>
bool DeviceFluid<Device>::locate(DeviceParticles<Device>& particles)
{
    std::int64_t const n = particles.count();
    if (particles.cell_of.size() != n)
    {
        particles.cell_of.resize(device_, n);
        device_.for_each(n, FillKernel<std::int32_t>{particles.cell_of.data(), -1});
    }
    status_.resize(device_, n);
    device_.for_each(n, LocateKernel{mesh_.finder(scene_->mapper.cell_grid()), particles.position.data(),
                                     mesh_.wall_faces(), particles.cell_of.data(), status_.data()});
    group_by_cell(particles);
    return highest_(n, EntryOf<std::int32_t, std::uint8_t>{status_.data()}, Highest{}) == 0;
}

template <class Device>
void DeviceFluid<Device>::group_by_cell(DeviceParticles<Device> const& particles)
{
    sort_(device_, {particles.cell_of.data(), particles.cell_of.size()}, mesh_.cell_count(), by_cell_);
}

template <class Device>
void DeviceFluid<Device>::occupied_cells(DeviceParticles<Device>& particles, exec::Buffer<std::uint8_t>& flags)
{
    if (particles.cell_of.size() != particles.count()) static_cast<void>(locate(particles));  // as apply() does
    occupied_.resize(device_, mesh_.cell_count());
    device_.for_each(mesh_.cell_count(), OccupiedKernel{by_cell_.offsets.data(), occupied_.data()});
    occupied_.download(device_, flags);
    device_.wait();
}

template <class Device>
template <class Law>
void DeviceFluid<Device>::sum_with(Law const& law, DeviceParticles<Device> const& particles)
{
    LayerView const layers = mapping_.layers();
    totals_.resize(device_, particles.count());
    device_.for_each(particles.count(), WeightTotalKernel<Law>{law, layers, particles.position.data(),
                                                               particles.cell_of.data(), totals_.data()});
    shares_.resize(device_, mapping_.layer_entries());
    device_.for_each(mapping_.layer_entries(),
                     ShareKernel<Law>{law, layers, particles.position.data(), particles.impulses.data(), totals_.data(),
                                      by_cell_.offsets.data(), by_cell_.members.data(), shares_.data()});
}

template <class Device>
void DeviceFluid<Device>::sum_into_cells(DeviceParticles<Device> const& particles, CellSums& sums)
{
    mapping_.with_law([&](auto const& law) { sum_with(law, particles); });
    std::int32_t const n = mesh_.cell_count();
    sums_.resize(device_, n);
    device_.for_each(n, ShareSumKernel{mapping_.layers(), shares_.data(), sums_.data()});
    device_.copy_out(sums_here_, sums_.data(), static_cast<std::size_t>(n) * sizeof(Share));
    device_.wait();
    sums.solid_volume.resize(n);
    sums.drag.resize(n);
    for (std::int32_t c = 0; c < n; ++c)
    {
        sums.solid_volume[c] = sums_here_[c].volume;
        sums.drag[c] = sums_here_[c].drag;
    }
    scene_->mapper.method().spread(sums);
}

template <class Device>
ImpulseSums DeviceFluid<Device>::impulse_sums(DeviceParticles<Device> const& particles)
{
    return sum_impulses_(particles.impulses.size(), ImpulseOf{particles.impulses.data(), particles.position.data()},
                         Add<ImpulseSums>{});
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// What the fluid does to the particles and the particles to the fluid's mesh, on a device.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/device/DeviceDem.hpp"
#include "engine/device/DeviceMapping.hpp"
#include "engine/device/DeviceParticles.hpp"
#include "exec/device/DeviceReduce.hpp"
#include "exec/device/DeviceSort.hpp"
#include "forces/LoadLaw.hpp"
#include "mapping/LocateKernel.hpp"
#include "mapping/PairwiseWeights.hpp"

namespace gimdem
{

/// The client's mesh in the memory of a device.
template <class Device>
class DeviceMesh
{
public:
    template <class T>
    using Array = exec::DeviceArray<Device, T>;

    void upload(Device& device, FluidScene const& scene);

    MeshKernelView view() const
    {
        return {cells_.data(),        face_centres_.data(), face_normals_.data(), owner_.data(),
                neighbour_.data(),    offsets_.data(),      cell_faces_.data(),   points_.data(),
                face_offsets_.data(), face_points_.data(),  internal_faces_,      cell_count()};
    }
    /// Finds cells; `grid`: that of the host, for its shape.
    CellFinder finder(BoxGrid const& grid) const
    {
        return {view(), grid.view_with(boxes_.data(), bin_offsets_.data(), bin_members_.data(), bin_nearest_.data())};
    }
    Quad const* cells() const { return cells_.data(); }
    std::int32_t cell_count() const { return static_cast<std::int32_t>(cells_.size()); }
    std::uint8_t const* wall_faces() const { return wall_faces_.data(); }
    CellBox const* boxes() const { return boxes_.data(); }

private:
    Array<Quad> cells_, face_centres_, face_normals_;
    Array<double> points_;
    Array<std::int32_t> owner_, neighbour_, offsets_, cell_faces_, face_offsets_, face_points_;
    Array<CellBox> boxes_;
    Array<std::int32_t> bin_offsets_, bin_members_, bin_nearest_;
    Array<std::uint8_t> wall_faces_;
    std::int32_t internal_faces_ = 0;
};

template <class Device>
class DeviceFluid
{
public:
    template <class T>
    using Array = exec::DeviceArray<Device, T>;

    explicit DeviceFluid(Device& device)
        : device_(device), sum_quads_(device), sum_impulses_(device), sum_counts_(device), highest_(device)
    {
    }
    ~DeviceFluid();
    DeviceFluid(DeviceFluid const&) = delete;
    DeviceFluid& operator=(DeviceFluid const&) = delete;

    void set_scene(FluidScene const& scene);
    /// Sees to what the mapping method needs for the sizes of the particles, which are on the host too.
    void take_sizes(ParticleState const& particles);
    void load(coupling::FluidFields const& fields);
    void set_void_fraction(exec::Buffer<double> const& values) { void_fraction_.upload(device_, values); }

    void apply(DeviceParticles<Device>& particles);
    FluidLoad const* loads() const { return loads_.data(); }
    Vec3 steady_force();
    std::int64_t clipped();

    bool locate(DeviceParticles<Device>& particles);
    /// Whoever changes the particles' cells calls it.
    void group_by_cell(DeviceParticles<Device> const& particles);
    void occupied_cells(DeviceParticles<Device>& particles, exec::Buffer<std::uint8_t>& flags);
    void sum_into_cells(DeviceParticles<Device> const& particles, CellSums& sums);
    ImpulseSums impulse_sums(DeviceParticles<Device> const& particles);

private:
    template <class Law>
    void sum_with(Law const& law, DeviceParticles<Device> const& particles);
    void stage(coupling::Span<double const> from, Quad* to) const;

    Device& device_;
    FluidScene const* scene_ = nullptr;
    std::unique_ptr<FluidScene> kept_;
    DeviceMesh<Device> mesh_;
    DeviceMapping<Device> mapping_;
    Array<Quad> velocity_, pressure_gradient_, void_gradient_;
    Array<double> velocity_gradient_, void_fraction_;
    Array<ParticleTotal> totals_;
    Array<FluidLoad> loads_;
    Array<std::int32_t> clips_;
    std::int64_t clips_before_ = 0;  ///< when there were more or fewer particles
    Array<std::uint8_t> status_, occupied_;
    exec::DeviceSort<Device> sort_;
    exec::DeviceGroups<Device> by_cell_;
    Array<Share> shares_, sums_;
    exec::DeviceReduce<Device, Quad> sum_quads_;
    exec::DeviceReduce<Device, ImpulseSums> sum_impulses_;
    exec::DeviceReduce<Device, std::int64_t> sum_counts_;
    exec::DeviceReduce<Device, std::int32_t> highest_;
    Quad* quads_here_ = nullptr;      ///< pinned: three fields of vectors
    double* numbers_here_ = nullptr;  ///< pinned: the gradient of the velocity
    Share* sums_here_ = nullptr;      ///< pinned: what goes back
};

}  // namespace gimdem

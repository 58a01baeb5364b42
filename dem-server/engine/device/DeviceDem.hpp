// SPDX-License-Identifier: BSD-3-Clause
/// The particles and one time step of their motion on a device: what DemSystem and CoupledEngine do, with all state in
/// the device's memory. The host sees it after download().
///
/// The stages (Device*.hpp) are templates over the device; this is the door that the rest of the program uses, whatever
/// the device. They launch the kernels that the host's stages launch, wherever those work on one particle or one pair
/// at a time, and the same laws.
#pragma once

#include <cstdint>
#include <memory>

#include "core/Case.hpp"
#include "exec/Execution.hpp"
#include "gimdem/coupling/Types.hpp"
#include "mapping/Mapper.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "search/NeighborList.hpp"
#include "walls/WallContacts.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem
{

/// The state of a DemSystem on the host.
struct HostState
{
    ParticleState& particles;
    NeighborList& neighbors;
    WallPairs& walls;
    exec::Buffer<Impulse>& impulses;
};

/// What a device needs to know of the scene. What it refers to outlives the device's part.
struct DemScene
{
    Case const& settings;
    Materials const& materials;
    WallGeometry const& walls;
    WallContacts& host_walls;  ///< knows where walls stand at which time
    double skin;               ///< [m]
};

/// The same of the fluid.
struct FluidScene
{
    Case const& settings;
    coupling::FluidProperties fluid;
    PolyMesh const& mesh;
    Mapper& mapper;  ///< for what it knows of the mesh
    exec::Buffer<std::uint8_t> const& wall_faces;
};

/// Sums over all particles of what a coupling step brought.
struct ImpulseSums
{
    Quad drag{0, 0, 0, 0};  ///< drag impulse [N s]; w: of its coefficient [kg]
    double magnitude = 0;   ///< sum of the drag impulses' magnitudes [N s]
    double volume = 0;      ///< [m^3]

    GIMDEM_HD friend ImpulseSums operator+(ImpulseSums const& a, ImpulseSums const& b)
    {
        return {a.drag + b.drag, a.magnitude + b.magnitude, a.volume + b.volume};
    }
};

class DeviceDem
{
public:
    virtual ~DeviceDem() = default;

    virtual void upload(HostState const& state) = 0;
    /// Waits for it.
    virtual void download(HostState const& state) = 0;

    // As in DemSystem. A step that finds a position that is not finite does nothing and returns false.
    [[nodiscard]] virtual bool prepare() = 0;
    [[nodiscard]] virtual bool step(double dt) = 0;
    virtual void begin_coupling_step(bool fluid) = 0;
    virtual Vec3 steady_fluid_force() = 0;
    virtual void take_impulses_of_one_second() = 0;
    virtual Vec3 wall_impulse() = 0;
    virtual std::int64_t rebuilds() const = 0;

    // As in CoupledEngine, FluidForces and Mapper. Steps with fluid need a mapping before them.
    virtual void set_fluid(FluidScene const& scene, ParticleState const& particles) = 0;
    virtual void load_fluid(coupling::FluidFields const& fields) = 0;
    virtual void set_void_fraction(exec::Buffer<double> const& void_fraction) = 0;
    virtual std::int64_t clipped() = 0;
    /// Finds the cell of every particle. False where some have left the mesh; they belong to the last cell before.
    [[nodiscard]] virtual bool locate() = 0;
    virtual void sum_into_cells(CellSums& sums) = 0;
    virtual ImpulseSums impulse_sums() = 0;
    /// Flags of the cells, 1 where the fluid of the next step is read by a particle.
    virtual void occupied_cells(exec::Buffer<std::uint8_t>& flags) = 0;
    /// Cells of the particles in their present order, for the host.
    virtual void download_cells(exec::Buffer<std::int32_t>& cell_of) = 0;

    /// The other way round: for whoever puts an earlier state back.
    virtual void upload_cells(exec::Buffer<std::int32_t> const& cell_of) = 0;

    virtual void finish() = 0;  ///< waits until all that was asked for is done

    virtual std::int64_t allocations() const = 0;  ///< of device memory since the beginning, where it is counted
};

/// The particles on the device that `execution` names; null for the host's backends. Throws UserError where this build
/// or this machine has no such device.
std::unique_ptr<DeviceDem> make_device_dem(exec::Execution const& execution, DemScene const& scene);

/// The same on a GPU; in builds without CUDA throws UserError.
std::unique_ptr<DeviceDem> make_cuda_dem(exec::Execution const& execution, DemScene const& scene);

}  // namespace gimdem

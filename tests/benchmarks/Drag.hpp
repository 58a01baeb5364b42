// SPDX-License-Identifier: BSD-3-Clause
/// Drag on the particles of benchmark_dem by air at rest of one void fraction: what the particle side pays for a fluid
/// within its steps, without mapping and exchange.
#pragma once

#include <vector>

#include "engine/DemSystem.hpp"
#include "mapping/Mapper.hpp"

namespace gimdem::benchmark
{

class Drag
{
public:
    Drag(Case const& settings, exec::Execution execution, PolyMesh const& mesh, DemSystem& system)
        : mapper_(execution, mesh),
          forces_(execution, settings.fluid_forces, settings.mapping.void_fraction_minimum, {1.2, 1.8e-5}),
          fluid_{forces_, mesh, mapper_.cell_of(), void_fraction_}
    {
        std::vector<double> const still(static_cast<std::size_t>(mesh.cell_count()) * 3, 0.0);
        coupling::FluidFields fields;
        fields.velocity = still;
        forces_.load(fields, mesh.cell_count());
        void_fraction_.resize(mesh.cell_count());
        void_fraction_.fill(0.4);
        exec::Buffer<std::uint8_t> wall_faces;
        wall_faces.resize(mesh.face_count());
        wall_faces.fill(1);
        mapper_.locate(std::as_const(system).particles(), wall_faces);
        system.set_permutation_listener([this](std::span<std::int32_t const> order) { mapper_.permute(order); });
    }
    Drag(Drag const&) = delete;

    FluidOnParticles const* fluid() const { return &fluid_; }

private:
    Mapper mapper_;
    FluidForces forces_;
    exec::Buffer<double> void_fraction_;
    FluidOnParticles fluid_;
};

}  // namespace gimdem::benchmark

// SPDX-License-Identifier: BSD-3-Clause
/// Some spheres, mapped: the fixture of tests of mapping methods.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "TestCase.hpp"
#include "mapping/Mapper.hpp"

namespace gimdem::test
{

inline MappingSettings method(std::string_view name)
{
    MappingSettings settings;
    settings.method = name;
    return settings;
}

/// Weights of each particle, by its id.
inline std::map<std::int64_t, std::vector<double>> rows_by_id(Mapper const& mapper, ParticleState const& particles)
{
    std::map<std::int64_t, std::vector<double>> by_id;
    CellRows const& layers = mapper.layers();
    std::int64_t at = 0;
    for (std::int32_t c = 0; c < layers.offsets.size() - 1; ++c)
        for (std::int64_t p = 0; p < particles.count(); ++p)
            if (mapper.cell_of()[p] == c)
                for (auto k = layers.offsets[c]; k < layers.offsets[c + 1]; ++k)
                    by_id[particles.id[p]].push_back(mapper.weights()[at++]);
    return by_id;
}

/// Some spheres on a mesh, all of whose boundary is walls.
struct Mapped
{
    Mapped(PolyMesh const& mesh, MappingSettings const& settings, std::vector<Sphere> const& spheres,
           exec::Execution execution = serial)
        : particles(particles_of(spheres)), mapper(execution, mesh, settings)
    {
        exec::Buffer<std::uint8_t> walls(mesh.face_count());
        walls.fill(1);
        impulses.resize(particles.count());
        for (std::int64_t p = 0; p < particles.count(); ++p)
            impulses[p] = {Quad::of(1e-6 * Vec3(std::sin(p), std::cos(p), 0.1), 1e-7 * double(1 + p % 7))};
        mapper.locate(particles, walls);
        mapper.compute_weights(particles);
        mapper.sum_into_cells(particles, impulses, sums);
    }

    /// Weights of the only particle, by cell.
    std::map<std::int32_t, double> weights() const
    {
        std::map<std::int32_t, double> by_cell;
        CellRows const& rows = mapper.layers();
        std::int32_t const first = rows.offsets[mapper.cell_of()[0]];
        for (std::int64_t k = 0; k < mapper.weights().size(); ++k)
            if (mapper.weights()[k] != 0) by_cell[rows.cells[first + k]] = mapper.weights()[k];
        return by_cell;
    }

    ParticleState particles;
    Mapper mapper;
    exec::Buffer<Impulse> impulses;
    CellSums sums;
};

}  // namespace gimdem::test

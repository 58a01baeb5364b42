// SPDX-License-Identifier: BSD-3-Clause
#include "MethodOnMesh.hpp"

#include <cmath>

#include "MappingScene.hpp"

namespace gimdem::benchmark
{

namespace
{

MappingSettings settings_of(std::string_view method)
{
    MappingSettings settings;
    settings.method = method;
    return settings;
}

}  // namespace

MethodOnMesh::MethodOnMesh(PolyMesh const& mesh, std::string_view method)
    : mesh_(mesh), mapper_(test::serial, mesh, settings_of(method)), wall_faces_(mesh.face_count())
{
    wall_faces_.fill(1);
    spreads_ = find_whether_it_spreads();
}

void MethodOnMesh::map(ParticleState const& particles)
{
    mapper_.locate(particles, wall_faces_);
    mapper_.compute_weights(particles);
}

// One particle in the middle of a cell: its weights and its sums are the same unless the method spreads.
bool MethodOnMesh::find_whether_it_spreads()
{
    auto const particles = test::particles_of({{mesh_.centroid(mesh_.cell_count() / 2), diameter / 2}});
    map(particles);
    mapper_.sum_into_cells(particles, no_impulses_, sums_);
    double difference = 0;
    std::vector<double> left(sums_.solid_volume.host().begin(), sums_.solid_volume.host().end());
    auto const rows = test::sparse_rows(mapper_);
    for (auto const& [cell, weight] : rows[0])
        left[static_cast<std::size_t>(cell)] -= weight * sphere_volume(diameter / 2);
    for (double const volume : left)
        difference += std::abs(volume);
    return difference > 1e-9 * sphere_volume(diameter / 2);
}

std::vector<test::SparseRow> MethodOnMesh::weights(std::vector<test::Sphere> const& spheres)
{
    map(test::particles_of(spheres));
    auto rows = test::sparse_rows(mapper_);
    if (spreads_)
        for (test::SparseRow& row : rows)
            row = spread(row);
    return rows;
}

test::SparseRow const& MethodOnMesh::spread(test::SparseRow const& row)
{
    auto const [at, is_new] = spread_rows_.try_emplace(row);
    if (!is_new) return at->second;
    sums_.solid_volume.fill(0);
    sums_.drag.fill({0, 0, 0, 0});
    for (auto const& [cell, weight] : row)
        sums_.solid_volume[cell] = weight;
    mapper_.method().spread(sums_);
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
        if (std::abs(sums_.solid_volume[c]) > 1e-12) at->second.push_back({c, sums_.solid_volume[c]});
    return at->second;
}

std::vector<double> MethodOnMesh::solid_fractions(std::vector<test::Sphere> const& spheres)
{
    auto const particles = test::particles_of(spheres);
    map(particles);
    mapper_.sum_into_cells(particles, no_impulses_, sums_);
    std::vector<double> fractions;
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
        fractions.push_back(sums_.solid_volume[c] / mesh_.volume(c));
    return fractions;
}

}  // namespace gimdem::benchmark

// SPDX-License-Identifier: BSD-3-Clause
/// At most 300 spheres in a box, on the host or on a device: for comparisons of the two.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "BoxMesh.hpp"
#include "SameBits.hpp"
#include "TestCase.hpp"
#include "engine/DemSystem.hpp"
#include "search/PairSprings.hpp"

namespace gimdem::test
{

/// Spheres on a lattice, moved a little, of radii up to `ratio` apart: with gaps, or where they differ with overlaps.
inline std::vector<Sphere> loose_spheres(int along, double ratio = 1)
{
    std::vector<Sphere> spheres;
    double const spacing = ratio > 1 ? 1.6e-3 : 2.05e-3;
    for (int k = 0; k < along; ++k)
        for (int j = 0; j < along; ++j)
            for (int i = 0; i < along; ++i)
            {
                int const n = i + along * (j + along * k);
                double const radius = 1e-3 / (1 + (ratio - 1) * (n % 7) / 6);
                spheres.push_back({spacing * (Vec3(i, j, k) + Vec3::Constant(0.5)) + 2e-5 * Vec3(n % 3, n % 5, n % 4),
                                   radius,
                                   {0.2 * (n % 3 - 1), 0.15 * (n % 5 - 2), -0.1 * (n % 4)},
                                   {10.0 * (n % 2), -5.0 * (n % 3), 3}});
            }
    return spheres;
}

/// A box with walls all around that holds `along`^3 loose spheres.
struct DeviceScene
{
    explicit DeviceScene(exec::Execution execution, Case given = falling(), int along = 6, double ratio = 1,
                         std::vector<std::int32_t> const& materials_of = {})
        : settings(std::move(given)),
          materials(settings),
          mesh(BoxMesh::make({3, 3, 3}, {along * 2.1e-3, along * 2.1e-3, along * 2.1e-3})),
          walls(mesh, {"bottom", "top"}, 1.5e-3, settings.wall),
          system(settings, execution, materials, walls, made(settings, loose_spheres(along, ratio), materials_of))
    {
        system.prepare();
        system.begin_coupling_step(nullptr);
        system.let_walls_move(true);
    }

    static Case falling()
    {
        Case settings = bead_case(0.8, 0.4);
        settings.dem.gravity = {0.5, 0.2, -9.81};
        return settings;
    }

    void run(int steps, double dt = 2e-5)
    {
        for (int s = 0; s < steps; ++s)
            system.step(dt);
    }
    DemSystem const& seen() const { return system; }

    Case settings;
    Materials materials;
    PolyMesh mesh;
    WallGeometry walls;
    DemSystem system;

private:
    static ParticleState made(Case const& settings, std::vector<Sphere> const& spheres,
                              std::vector<std::int32_t> const& materials_of)
    {
        ParticleState state = particles_of(spheres, settings.materials[0].density);
        for (std::int64_t i = 0; i < state.count() && !materials_of.empty(); ++i)
            state.material[i] = materials_of[static_cast<std::size_t>(i) % materials_of.size()];
        return state;
    }
};

inline void expect_same_bits(DemSystem const& a, DemSystem const& b)
{
    EXPECT_TRUE(same_bits(a.particles().id, b.particles().id));
    EXPECT_TRUE(same_bits(a.particles().position, b.particles().position));
    EXPECT_TRUE(same_bits(a.particles().velocity, b.particles().velocity));
    EXPECT_TRUE(same_bits(a.particles().angular_velocity, b.particles().angular_velocity));
    EXPECT_TRUE(same_bits(a.particles().force, b.particles().force));
    EXPECT_TRUE(same_bits(tangential_of_pairs(a.neighbors()), tangential_of_pairs(b.neighbors())));
    EXPECT_TRUE(same_bits(a.walls().pairs().displacement, b.walls().pairs().displacement));
}

/// Largest difference of two arrays of vectors over the largest magnitude in the first.
inline double relative_difference(exec::Buffer<Quad> const& a, exec::Buffer<Quad> const& b)
{
    double largest = 1e-300, difference = 0;
    for (std::int64_t i = 0; i < std::min(a.size(), b.size()); ++i)
    {
        largest = std::max(largest, a[i].xyz().norm());
        difference = std::max(difference, (a[i].xyz() - b[i].xyz()).norm());
    }
    return a.size() == b.size() ? difference / largest : 1;
}

/// The same lists, and numbers that differ by rounding.
inline void expect_same_within(DemSystem const& host, DemSystem const& device, double tolerance)
{
    EXPECT_TRUE(same_bits(host.particles().id, device.particles().id));
    EXPECT_TRUE(same_bits(host.neighbors().row_offsets, device.neighbors().row_offsets));
    EXPECT_TRUE(same_bits(host.neighbors().second, device.neighbors().second));
    EXPECT_TRUE(same_bits(touches_of_pairs(host.neighbors()), touches_of_pairs(device.neighbors())));
    EXPECT_TRUE(same_bits(host.walls().pairs().offsets, device.walls().pairs().offsets));
    EXPECT_TRUE(same_bits(host.walls().pairs().plane, device.walls().pairs().plane));
    ParticleState const &a = host.particles(), &b = device.particles();
    EXPECT_LT(relative_difference(a.position, b.position), tolerance);
    EXPECT_LT(relative_difference(a.velocity, b.velocity), tolerance);
    EXPECT_LT(relative_difference(a.angular_velocity, b.angular_velocity), tolerance);
    EXPECT_LT(relative_difference(a.force, b.force), tolerance);
    EXPECT_LT(relative_difference(a.torque, b.torque), tolerance);
    EXPECT_LT(relative_difference(tangential_of_pairs(host.neighbors()), tangential_of_pairs(device.neighbors())),
              tolerance);
    EXPECT_LT(relative_difference(rolling_of_pairs(host.neighbors()), rolling_of_pairs(device.neighbors())), tolerance);
    EXPECT_LT(relative_difference(host.walls().pairs().displacement, device.walls().pairs().displacement), tolerance);
}

}  // namespace gimdem::test

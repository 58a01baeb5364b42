// SPDX-License-Identifier: BSD-3-Clause
/// What benchmark_dem computes: beads of 1.545 mm with the features that its options ask for.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "TestCase.hpp"
#include "mesh/PolyMesh.hpp"
#include "walls/WallGeometry.hpp"

namespace gimdem::benchmark
{

struct SceneOptions
{
    std::string data;                           ///< state to start from; empty: `start`
    std::string start = "lattice";              ///< lattice | random
    std::int64_t count = 17'563;                ///< particles of `start`
    std::vector<double> box{0.09, 0.008, 0.5};  ///< sides [m]
    std::vector<int> tiles{1, 1};               ///< copies of state and box side by side along x and y
    double spacing = 1.65e-3, jitter = 2e-5;    ///< of the lattice [m]
    double speed = 0;                           ///< Gaussian velocities are added, of this deviation per axis [m/s]

    std::string sides = "walls";  ///< walls: open at the top | closed | floor: x, y periodic | periodic | none
    double gravity = 9.81;        ///< [m/s^2]
    std::string precision = "double";
    std::string law = "hertz-mindlin", rolling = "none", cohesion = "none";
    double restitution = 0.9, friction = 0.3;
    int materials = 1;      ///< taken in turn, with the same constants
    double size_step = 0;   ///< every second particle is smaller by this share
    double size_ratio = 1;  ///< random: largest to smallest diameter, uniform by number
    double skin = 0.3;      ///< of the neighbour list, in smallest radii
    bool drag = false;      ///< by air at rest
};

struct Scene
{
    explicit Scene(SceneOptions const& options);

    Case settings;
    std::array<double, 3> box;  ///< sides with all tiles [m]
    PolyMesh mesh;              ///< with drag of cells as a fluid has them, without of one
    WallGeometry walls;
    std::vector<test::Sphere> spheres;

    /// The particles, each of its material.
    ParticleState particles() const;
};

}  // namespace gimdem::benchmark

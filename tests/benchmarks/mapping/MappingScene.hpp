// SPDX-License-Identifier: BSD-3-Clause
/// Meshes that mapping methods are compared on, and where on them particles are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "TestCase.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem::benchmark
{

inline constexpr double diameter = 1.545e-3;       ///< of all particles, as in cases/wachem-bed [m]
inline constexpr double solid_fraction = 0.4;      ///< of all packings
inline constexpr std::int64_t bed_count = 17'563;  ///< particles of cases/wachem-bed

/// Names of the meshes that are made here; any other is a folder with a polyMesh of a box.
inline constexpr std::string_view built_in_meshes[] = {"hexahedra", "stretched-2", "stretched-4", "tetrahedra",
                                                       "polyhedra"};

struct Region
{
    Vec3 low, high;  ///< [m]
};

struct MeshOptions
{
    std::string mesh = "hexahedra";
    double ratio = 1.76;  ///< a / d_p, a the cube root of a cell's mean volume; of built-in meshes
    double width = 0;     ///< at least so wide is a box of them [diameters]
    int cells = 5;        ///< at least so many cells (of tetrahedra: cubes of them) is it wide
};

struct MappingScene
{
    explicit MappingScene(MeshOptions const& options);

    PolyMesh mesh;
    Region box;          ///< that it fills
    Region middle;       ///< centres for one particle at a time: one period of cells, or all that is clear of the walls
    bool is_from_files;  ///< not made here

    double ratio() const;  ///< cube root of the mean volume of the cells, in diameters
    /// Spheres that do not overlap, `count` of them from the bottom up, or as many as the box holds at that solid
    /// fraction where this is less or `count` is 0. Moved `sweeps` times by Monte Carlo.
    std::vector<test::Sphere> packing(std::int64_t count, int sweeps) const;
    Region bed(std::int64_t count) const;  ///< that they lie in
};

}  // namespace gimdem::benchmark

// SPDX-License-Identifier: BSD-3-Clause
/// Triangles side by side in one plane are one plane; planes that meet at a small angle are one smooth patch.
#pragma once

#include <cstdint>
#include <vector>

#include "walls/SurfaceMesh.hpp"

namespace gimdem
{

/// Planes that meet at less than 25 degrees stand for a smooth surface, theory.md (D.54): its cosine.
inline constexpr double smooth_cosine = 0.9063077870366499;

struct SurfacePlanes
{
    std::vector<std::int32_t> plane_of_triangle;
    std::vector<std::uint8_t> rim_of_triangle;  ///< bit k: side k is where the plane ends
    std::vector<Quad> planes;                   ///< unit normal, w: offset [m]
    std::vector<double> slack;                  ///< how far a corner is from its plane [m]
    std::vector<std::int32_t> patch_of_plane;   ///< the lowest plane of its patch
};

/// Planes of a checked surface, theory.md (D.53). `two_sided`: normals may point to either side.
SurfacePlanes find_planes(SurfaceMesh const& surface, bool two_sided);

/// Joins planes into patches: the root of each tree is its lowest plane.
class PatchJoiner
{
public:
    explicit PatchJoiner(std::int32_t planes);

    /// Planes a and b share an edge; they are one patch where they meet smoothly.
    void join(std::int32_t a, std::int32_t b, Vec3 const& normal_a, Vec3 const& normal_b, bool two_sided);
    std::int32_t patch_of(std::int32_t plane) const;

private:
    std::vector<std::int32_t> parent_;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// On which side of a closed surface a point is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "walls/WallView.hpp"

namespace gimdem
{

/// Counts how often a closed surface winds around a point: along a ray from the point upwards, each triangle that the
/// ray leaves through counts 1, each that it enters through -1, theory.md (D.57).
class SurfaceSide
{
public:
    explicit SurfaceSide(std::span<WallTriangle const> triangles);

    /// 1 inside, 0 outside where normals point outwards; -1 inside where they point inwards.
    int winding(Vec3 const& y) const;

private:
    std::int64_t slab_of(double x) const;

    std::span<WallTriangle const> triangles_;
    double low_ = 0, width_ = 1;                    ///< of the slabs across x [m]
    std::vector<std::vector<std::int32_t>> slabs_;  ///< the triangles in each
};

}  // namespace gimdem

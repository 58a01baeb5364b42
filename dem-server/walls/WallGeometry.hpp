// SPDX-License-Identifier: BSD-3-Clause
/// The walls: those boundary faces of the client's mesh that stop particles, coplanar faces joined into one plane, so
/// that a sphere that rolls over the seam of two faces touches one wall and not two.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exec/Buffer.hpp"
#include "exec/Sort.hpp"
#include "exec/Vector.hpp"
#include "mesh/PolyMesh.hpp"
#include "search/CellGrid.hpp"

namespace gimdem
{

/// One triangle of a wall. A face is a fan of triangles around its centre: a, b is an edge of the face, c the centre.
struct WallTriangle
{
    Quad a, b, c;        ///< corners [m]
    std::int32_t plane;  ///< number of the plane it lies in
    bool rim;            ///< edge ab is where the plane ends
};

/// What kernels see of the walls.
struct WallView
{
    Quad const* plane_normal;  ///< unit, into the domain; w: offset, normal . x = w on the plane [m]
    WallTriangle const* triangles;
    CellGrid grid;                     ///< boxes of space ...
    std::int32_t const* grid_offsets;  ///< ... and the triangles within reach of each, by rising plane
    std::int32_t const* grid_triangles;
};

class WallGeometry
{
public:
    /// Walls are the patches of kind wall and those named in `also`; `reach` [m] is how near a particle's centre can be
    /// to a wall that it feels. Throws UserError for a name in `also` that is no patch.
    WallGeometry(PolyMesh const& mesh, std::vector<std::string> const& also, double reach);

    std::int32_t plane_count() const { return static_cast<std::int32_t>(planes_.size()); }
    std::int64_t triangle_count() const { return triangles_.size(); }
    bool is_wall_face(std::int32_t face) const { return plane_of_face_[static_cast<std::size_t>(face)] >= 0; }
    WallView view() const;

private:
    void join_planes(PolyMesh const& mesh, std::vector<std::string> const& also);
    void cut_into_triangles(PolyMesh const& mesh);
    void bin_triangles(PolyMesh const& mesh, double reach);
    std::int32_t plane_of(Vec3 const& normal, double offset, double tolerance);

    exec::Buffer<Quad> planes_;
    std::vector<std::int32_t> plane_of_face_;  ///< -1 for faces that are no wall
    exec::Buffer<WallTriangle> triangles_;
    CellGrid grid_;
    exec::Buffer<std::int32_t> grid_offsets_, grid_triangles_;
};

}  // namespace gimdem

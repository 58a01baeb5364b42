// SPDX-License-Identifier: BSD-3-Clause
/// The client's polyhedral mesh with its geometry: faces, volumes, centroids and who touches whom.
#pragma once

#include <cstdint>
#include <span>

#include "exec/Buffer.hpp"
#include "exec/Vector.hpp"
#include "gimdem/coupling/Types.hpp"

namespace gimdem
{

/// What kernels see of the mesh.
struct MeshKernelView
{
    Quad const* cell;                  ///< centroid [m], w: volume [m^3]
    Quad const* face_centre;           ///< centroid [m], w: area [m^2]
    Quad const* face_normal;           ///< unit, out of the owner; w: how far its points are off its plane [m]
    std::int32_t const* owner;         ///< cell numbers
    std::int32_t const* neighbour;     ///< cell numbers; internal faces only
    std::int32_t const* cell_offsets;  ///< faces of cell c are cell_faces[cell_offsets c .. c + 1)
    std::int32_t const* cell_faces;
    double const* points;              ///< shape=(n_points, 3) [m]
    std::int32_t const* face_offsets;  ///< points of face f are face_points[face_offsets f .. f + 1)
    std::int32_t const* face_points;
    std::int32_t internal_face_count;
    std::int32_t cell_count;

    /// The cell across a face, or -1 at the boundary.
    GIMDEM_HD std::int32_t across(std::int32_t face, std::int32_t from) const
    {
        if (face >= internal_face_count) return -1;
        return owner[face] == from ? neighbour[face] : owner[face];
    }

    /// How far x lies outside of the cell `from` through its `face` [m]; negative inside.
    GIMDEM_HD double distance_outside(std::int32_t face, std::int32_t from, Vec3 const& x) const
    {
        double const d = (x - face_centre[face].xyz()).dot(face_normal[face].xyz());
        return owner[face] == from ? d : -d;
    }
};

class PolyMesh
{
public:
    /// Throws UserError for what check_geometry() refuses, and for a cell with no faces, a volume that is not positive
    /// or a face without area: names the cell or face, its place and what to do.
    explicit PolyMesh(coupling::Mesh topology);

    std::int32_t cell_count() const { return topology_.cell_count; }
    std::int32_t face_count() const { return static_cast<std::int32_t>(topology_.owner.size()); }
    std::int32_t internal_face_count() const { return static_cast<std::int32_t>(topology_.neighbour.size()); }
    coupling::Mesh const& topology() const { return topology_; }
    coupling::Patch const* find_patch(std::string const& name) const;  ///< null where there is none

    Vec3 point(std::int32_t p) const;
    std::span<std::int32_t const> points_of_face(std::int32_t face) const;
    std::span<std::int32_t const> faces_of_cell(std::int32_t cell) const;
    double volume(std::int32_t cell) const { return cells_[cell].w; }            ///< [m^3]
    Vec3 centroid(std::int32_t cell) const { return cells_[cell].xyz(); }        ///< [m]
    double face_area(std::int32_t face) const { return face_centres_[face].w; }  ///< [m^2]
    Vec3 face_centre(std::int32_t face) const { return face_centres_[face].xyz(); }
    Vec3 face_normal(std::int32_t face) const { return face_normals_[face].xyz(); }
    double face_warp(std::int32_t face) const { return face_normals_[face].w; }  ///< (G.3) [m]
    Vec3 low() const { return low_; }                                            ///< corner of the bounding box [m]
    Vec3 high() const { return high_; }                                          ///< the other one [m]

    MeshKernelView view() const;

private:
    void compute_faces();
    double warp(std::int32_t face, Vec3 const& centre, Vec3 const& normal, Vec3 const& middle) const;
    void list_cell_faces();
    void compute_cells();

    coupling::Mesh topology_;
    exec::Buffer<Quad> cells_, face_centres_, face_normals_;
    exec::Buffer<std::int32_t> cell_offsets_, cell_faces_;
    Vec3 low_, high_;
};

/// Cells that belong to each cell: the cell itself first, then others, each once. Symmetric: where j is in the row of
/// i, i is in the row of j.
struct CellRows
{
    exec::Buffer<std::int32_t> offsets;  ///< shape=(n_cells + 1,)
    exec::Buffer<std::int32_t> cells;    ///< shape=(offsets.back(),)
};

/// First and second layer of face neighbours, theory.md (G.9): for each cell the cell itself, then its face neighbours,
/// then the face neighbours of those.
struct CellLayers : CellRows
{
    explicit CellLayers(PolyMesh const& mesh);
};

}  // namespace gimdem

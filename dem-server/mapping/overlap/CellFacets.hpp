// SPDX-License-Identifier: BSD-3-Clause
/// The cells of a mesh as polyhedra of flat convex facets, theory.md (G.20): a face that is flat and convex is one
/// facet, any other is its fan of triangles (G.1).
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "mesh/NearbyCells.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem::overlap
{

/// What kernels see of the facets.
struct CellFacetsView
{
    static constexpr int most_corners = 12;  ///< of a facet

    double const* points;                ///< shape=(n_points, 3) [m]
    std::int32_t const* facet_offsets;   ///< facets of face f are facet_offsets[f] .. facet_offsets[f + 1)
    std::int32_t const* corner_offsets;  ///< corners of facet i are corners[corner_offsets[i] ...)
    std::int32_t const* corners;         ///< numbers of points, counterclockwise around the normal
    Quad const* edges;                   ///< to each corner from the one before: unit vector; w: length [m]
    Quad const* normal;                  ///< of each facet: unit, out of the face's owner; w: area [m^2]
    CellBox const* boxes;                ///< of each cell
    std::int32_t const* cell_offsets;    ///< faces of cell c are cell_faces[cell_offsets[c] ...)
    std::int32_t const* cell_faces;
    std::int32_t const* owner;      ///< of each face
    std::int32_t const* neighbour;  ///< of each internal face
    std::int32_t internal_face_count;

    GIMDEM_HD Vec3 point(std::int32_t p) const
    {
        return {points[3 * static_cast<std::int64_t>(p)], points[3 * static_cast<std::int64_t>(p) + 1],
                points[3 * static_cast<std::int64_t>(p) + 2]};
    }
};

class CellFacets
{
public:
    /// How far corners of a facet may be from its plane, in units of the root of its area: rounding of the mesh.
    static constexpr double flatness = 1e-12;

    /// `mesh` outlives the facets.
    explicit CellFacets(PolyMesh const& mesh);

    CellFacetsView view() const;

    // What a device needs beside the mesh and its boxes.
    exec::Buffer<double> const& points() const { return points_; }
    exec::Buffer<std::int32_t> const& facet_offsets() const { return facet_offsets_; }
    exec::Buffer<std::int32_t> const& corner_offsets() const { return corner_offsets_; }
    exec::Buffer<std::int32_t> const& corners() const { return corners_; }
    exec::Buffer<Quad> const& edges() const { return edges_; }
    exec::Buffer<Quad> const& normals() const { return normal_; }

private:
    void add_face(std::int32_t face);
    Vec3 point(std::int32_t p) const;
    void add_facet(std::int32_t const* corners, int count, Vec3 const& area);
    bool is_flat_and_convex(std::int32_t face) const;

    PolyMesh const& mesh_;
    exec::Buffer<double> points_;
    exec::Buffer<std::int32_t> facet_offsets_, corner_offsets_, corners_;
    exec::Buffer<Quad> edges_, normal_;
    exec::Buffer<CellBox> boxes_;
};

}  // namespace gimdem::overlap

// SPDX-License-Identifier: BSD-3-Clause
/// The walls: those boundary faces of the client's mesh that stop particles, and the walls of the case file. Coplanar
/// faces are joined into one plane, so that a sphere that rolls over the seam of two faces touches one wall and not
/// two.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "exec/Buffer.hpp"
#include "exec/Sort.hpp"
#include "exec/Vector.hpp"
#include "mesh/PolyMesh.hpp"
#include "walls/SurfaceMesh.hpp"
#include "walls/WallMotion.hpp"
#include "walls/WallView.hpp"

namespace gimdem
{

class WallGeometry
{
public:
    /// Walls are the patches of kind wall, those named in `also`, and `items`; `reach` [m] is how near a particle's
    /// centre can be to a wall that it feels. Throws UserError for a name in `also` that is no patch, and for a file of
    /// `items` that is no wall.
    WallGeometry(PolyMesh const& mesh, std::vector<std::string> const& also, double reach,
                 std::vector<WallItemSettings> const& items = {});

    /// The walls of the case file alone.
    WallGeometry(std::vector<WallItemSettings> const& items, double reach);

    std::int32_t plane_count() const { return static_cast<std::int32_t>(surfaces_.size()); }
    std::int64_t triangle_count() const { return triangles_.size(); }
    bool is_wall_face(std::int32_t face) const { return planes_of_face_[static_cast<std::size_t>(face)].first >= 0; }
    WallView view() const;

    std::int32_t body_count() const { return static_cast<std::int32_t>(bodies_.size()); }
    /// First body of the case file; one before it is the client's mesh.
    std::int32_t first_item() const { return mesh_body_ + 1; }
    /// Material of a body; empty: that of [walls].
    std::string const& material(std::int32_t body) const { return materials_[static_cast<std::size_t>(body)]; }
    /// What messages call a body.
    std::string const& name(std::int32_t body) const { return names_[static_cast<std::size_t>(body)]; }
    /// Whether a body is a closed surface of the case file.
    bool is_closed(std::int32_t body) const { return closed_[static_cast<std::size_t>(body)]; }
    std::span<WallTriangle const> triangles_of(std::int32_t body) const;
    WallMotion const& motion(std::int32_t body) const { return motions_[static_cast<std::size_t>(body)]; }

    /// All that decides what the walls do to particles, as text: for names of files that depend on it.
    std::string description() const;

private:
    /// The plane of a flat face; of a warped one, the planes of the triangles that its edges make with its centre.
    struct FacePlanes
    {
        std::int32_t first = -1;  ///< -1: the face is no wall
        bool warped = false;      ///< one plane for each edge, from the first one on
    };

    void add_mesh(PolyMesh const& mesh, std::vector<std::string> const& also);
    void join_planes(PolyMesh const& mesh, std::vector<std::string> const& also);
    void cut_into_triangles(PolyMesh const& mesh);
    void join_patches(PolyMesh const& mesh);
    FacePlanes add_planes(PolyMesh const& mesh, std::int32_t face, double tolerance);
    std::int32_t plane_of(Vec3 const& normal, double offset, double tolerance);
    template <class Visit>
    void visit_edges(PolyMesh const& mesh, Visit&& visit) const;

    void add_item(WallItemSettings const& item);
    void add_surfaces(SurfaceMesh const& surface, WallItemSettings const& item);

    void begin_body(std::string const& name, std::string const& material, WallMotion const& motion);
    WallSurface& add_surface(SurfaceKind kind, Vec3 const& direction, double offset);
    void end_body();
    void bin_triangles(WallBody& body, std::int64_t first_triangle);

    double reach_;
    std::int32_t mesh_body_ = -1;
    exec::Buffer<WallSurface> surfaces_;
    exec::Buffer<WallTriangle> triangles_;
    exec::Buffer<WallBody> bodies_;
    exec::Buffer<std::int32_t> grid_offsets_, grid_triangles_;
    std::vector<std::string> names_, materials_;
    std::vector<bool> closed_;
    std::vector<WallMotion> motions_;
    std::vector<FacePlanes> planes_of_face_;
};

}  // namespace gimdem

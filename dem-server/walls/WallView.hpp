// SPDX-License-Identifier: BSD-3-Clause
/// What kernels see of the walls. A wall is a body with surfaces; all of it is given in the body's own frame, where it
/// never moves.
#pragma once

#include <cstdint>

#include "exec/Vector.hpp"
#include "search/CellGrid.hpp"

namespace gimdem
{

/// One triangle of a wall. A face of the mesh is a fan of triangles around its centre: a, b is an edge of the face, c
/// the centre.
struct WallTriangle
{
    Quad a, b, c;        ///< corners [m]
    std::int32_t plane;  ///< number of the surface it lies in
    std::uint8_t rim;    ///< where the plane ends: bit 0 edge ab, bit 1 bc, bit 2 ca
};

enum class SurfaceKind : std::uint8_t
{
    facets,    ///< triangles of one plane
    plane,     ///< infinite plane
    cylinder,  ///< tube
};

/// What a particle touches once and holds one tangential spring for.
struct WallSurface
{
    Quad normal;   ///< unit, towards the particles; w: offset, normal . y = w on it [m]. Cylinder: axis; w: radius [m]
    Quad point;    ///< cylinder: where the axis begins [m]; w: length [m]
    double slack;  ///< how far its triangles may lie off the plane [m]
    std::int32_t body;            ///< whose it is
    std::int32_t patch;           ///< surfaces of one patch meet smoothly
    std::int32_t triangle;        ///< its first triangle ...
    std::int32_t triangle_count;  ///< ... and how many
    SurfaceKind kind;
    bool inside;     ///< cylinder, closed surface: particles are inside
    bool endless;    ///< cylinder: has no ends
    bool two_sided;  ///< pushes away on either side
    double behind;   ///< a centre that is farther behind than this many radii is not pushed back [1]
};

/// A rigid wall.
struct WallBody
{
    CellGrid grid;             ///< boxes of space over its triangles
    std::int64_t grid_begin;   ///< its first entry of grid_offsets
    std::int32_t surface;      ///< its first surface ...
    std::int32_t surface_end;  ///< ... and one beyond its last
    Constant3 low, high;       ///< no particle outside this box feels its triangles [m]
    bool has_triangles;
    bool moves;
};

struct WallView
{
    WallSurface const* surfaces;
    WallTriangle const* triangles;  ///< by rising surface
    WallBody const* bodies;
    std::int32_t body_count;
    std::int32_t const* grid_offsets;    ///< of each body's boxes ...
    std::int32_t const* grid_triangles;  ///< ... the triangles within reach, by rising surface
};

}  // namespace gimdem

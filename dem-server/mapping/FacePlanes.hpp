// SPDX-License-Identifier: BSD-3-Clause
/// The planes of each cell's internal faces, eight side by side, so that a point is tried against eight at a time.
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "exec/Octet.hpp"
#include "exec/Vector.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// Eight planes of one cell, relative to its centroid: x is outside of one by normal . (x - centroid) - offset.
struct PlaneOctet
{
    exec::Octet x, y, z;  ///< unit normals, out of the cell
    exec::Octet offset;   ///< [m]
};

/// What kernels see of the planes.
struct FacePlanesView
{
    Quad const* cell;             ///< centroids [m]
    std::int32_t const* offsets;  ///< planes of cell c are planes[offsets[c] .. offsets[c + 1]), at least one
    PlaneOctet const* planes;     ///< lanes without a face have a plane that everything is behind of

    /// How far x is inside of each of eight planes of a cell [m].
    exec::Octet inside(std::int32_t eight, std::int32_t of_cell, Quad const& at) const
    {
        Quad const& centre = cell[of_cell];
        PlaneOctet const& p = planes[eight];
        using exec::minus_product;
        using exec::Octet;
        Octet const x = Octet::Constant(at.x - centre.x), y = Octet::Constant(at.y - centre.y),
                    z = Octet::Constant(at.z - centre.z);
        return minus_product(minus_product(minus_product(p.offset, p.x, x), p.y, y), p.z, z);
    }
};

/// Of all cells of a mesh.
class FacePlanes
{
public:
    /// `mesh` outlives the planes.
    explicit FacePlanes(PolyMesh const& mesh);

    FacePlanesView view() const { return {mesh_.view().cell, offsets_.view().data, planes_.view().data}; }

private:
    PolyMesh const& mesh_;
    exec::Buffer<std::int32_t> offsets_;
    exec::Buffer<PlaneOctet> planes_;
};

}  // namespace gimdem

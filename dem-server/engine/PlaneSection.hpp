// SPDX-License-Identifier: BSD-3-Clause
/// Means over a plane that cuts the mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/Case.hpp"
#include "mesh/PolyMesh.hpp"

namespace gimdem
{

/// The cells that a plane cuts, each with the area of its section.
class PlaneSection
{
public:
    /// Throws UserError for a plane that misses the mesh.
    PlaneSection(PolyMesh const& mesh, PlaneSettings const& plane);

    /// Area-weighted mean of a cell field over the section. `gradient`, where given, carries each cell's value from its
    /// centroid to the middle of its section: shape=(n_cells, 3).
    double mean(std::span<double const> values, std::span<double const> gradient = {}) const;

    /// Adds the cells that it cuts.
    void list_cells(std::vector<std::int32_t>& cells) const
    {
        for (Part const& part : parts_)
            cells.push_back(part.cell);
    }

    double area() const { return area_; }  ///< [m^2]

private:
    struct Part
    {
        std::int32_t cell;
        double area;
        Vec3 offset;  ///< middle of the section - centroid of the cell [m]
    };
    std::vector<Part> parts_;
    double area_ = 0;
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// A mesh in owner/neighbour addressing as VTK's list of cells.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::output
{

/// A cell by its faces, each a list of points whose normal (right-hand rule) leaves the cell.
using CellFaces = std::vector<std::vector<std::int32_t>>;

/// The eight points of a hexahedron in VTK's order: the first four go round one face with the normal into the cell,
/// the last four stand opposite to them. Empty for a cell of any other shape.
std::optional<std::array<std::int32_t, 8>> hexahedron_of(CellFaces const& cell);

/// What VTK's XML format stores of the cells of an unstructured grid.
struct CellTopology
{
    static constexpr std::uint8_t hexahedron = 12;  ///< VTK's number of the cell type
    static constexpr std::uint8_t polyhedron = 42;

    explicit CellTopology(coupling::Mesh const& mesh);

    std::vector<std::int64_t> connectivity;  ///< points of cell after cell
    std::vector<std::int64_t> offsets;       ///< shape=(n_cells,): end of each cell in connectivity
    std::vector<std::uint8_t> types;         ///< shape=(n_cells,)
    std::vector<std::int64_t> faces;         ///< per polyhedron: number of faces, then of each its size and points
    std::vector<std::int64_t> face_offsets;  ///< shape=(n_cells,): end of each polyhedron in faces, -1 for others

private:
    void add_hexahedron(std::array<std::int32_t, 8> const& points);
    void add_polyhedron(CellFaces const& cell);
};

}  // namespace gimdem::output

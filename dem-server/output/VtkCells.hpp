// SPDX-License-Identifier: BSD-3-Clause
/// Fields on a polyhedral mesh as a ParaView file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::output
{

/// One value of `components` numbers per cell, by reference.
struct CellField
{
    std::string name;
    int components = 1;              ///< 1 scalar, 3 vector, 9 tensor
    std::span<double const> values;  ///< shape=(n_cells, components), row-major
};

/// Writes frames of cell fields on one mesh as VTK UnstructuredGrid (.vtu): reals as Float32, compressed.
///
/// A cell that is a hexahedron is written as one, any other as a polyhedron. The topology is prepared and compressed
/// once and serves every frame.
class VtkCells
{
public:
    explicit VtkCells(coupling::Mesh const& mesh);
    ~VtkCells();
    VtkCells(VtkCells&&) noexcept;
    VtkCells& operator=(VtkCells&&) noexcept;

    /// Write `fields` at `time` [s]. The file appears whole or not at all.
    ///
    /// Throws UserError with the path and the system's reason, std::invalid_argument for a field of the wrong size.
    void write(std::filesystem::path const& file, double time, std::span<CellField const> fields) const;

private:
    struct Topology;
    std::unique_ptr<Topology const> topology_;
};

}  // namespace gimdem::output

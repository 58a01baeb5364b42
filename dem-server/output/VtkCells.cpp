// SPDX-License-Identifier: BSD-3-Clause
#include "output/VtkCells.hpp"

#include <stdexcept>
#include <vector>

#include "output/CellTopology.hpp"
#include "output/VtkXml.hpp"

namespace gimdem::output
{

/// The part of every file that does not change.
struct VtkCells::Topology
{
    explicit Topology(coupling::Mesh const& mesh) : Topology(mesh, CellTopology(mesh)) {}

    Topology(coupling::Mesh const& mesh, CellTopology const& cells)
        : point_count(mesh.points.size() / 3),
          cell_count(cells.types.size()),
          points(vtk_reals("Points", mesh.points, 3)),
          cell_arrays{vtk_integers("connectivity", cells.connectivity), vtk_integers("offsets", cells.offsets),
                      vtk_bytes("types", cells.types)}
    {
        if (cells.faces.empty()) return;
        cell_arrays.push_back(vtk_integers("faces", cells.faces));
        cell_arrays.push_back(vtk_integers("faceoffsets", cells.face_offsets));
    }

    std::size_t point_count;
    std::size_t cell_count;
    VtkArray points;
    std::vector<VtkArray> cell_arrays;
};

VtkCells::VtkCells(coupling::Mesh const& mesh) : topology_(std::make_unique<Topology const>(mesh)) {}
VtkCells::~VtkCells() = default;
VtkCells::VtkCells(VtkCells&&) noexcept = default;
VtkCells& VtkCells::operator=(VtkCells&&) noexcept = default;

void VtkCells::write(std::filesystem::path const& file, double time, std::span<CellField const> fields) const
{
    VtkArray const time_array = vtk_time(time);
    std::vector<VtkArray> data;
    for (auto const& field : fields)
    {
        if (field.values.size() != topology_->cell_count * static_cast<std::size_t>(field.components))
            throw std::invalid_argument("cell field " + field.name + " has " + std::to_string(field.values.size()) +
                                        " values for " + std::to_string(topology_->cell_count) + " cells with " +
                                        std::to_string(field.components) + " components");
        data.push_back(vtk_reals(field.name, field.values, field.components));
    }

    VtkDocument document("UnstructuredGrid");
    document.open("FieldData").add(time_array).close();
    document.open("Piece", "NumberOfPoints=\"" + std::to_string(topology_->point_count) + "\" NumberOfCells=\"" +
                               std::to_string(topology_->cell_count) + '"');
    document.open("CellData");
    for (auto const& array : data)
        document.add(array);
    document.close();
    document.open("Points").add(topology_->points).close();
    document.open("Cells");
    for (auto const& array : topology_->cell_arrays)
        document.add(array);
    document.close();
    document.write(file);
}

}  // namespace gimdem::output

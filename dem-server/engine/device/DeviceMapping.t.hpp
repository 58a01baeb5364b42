// SPDX-License-Identifier: BSD-3-Clause
/// Body of DeviceMapping, for the files that instantiate it.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/Error.hpp"
#include "engine/device/DeviceMapping.hpp"
#include "mapping/methods/DividedVolume.hpp"
#include "mapping/methods/ExactOverlap.hpp"
#include "mapping/methods/GaussianKernel.hpp"
#include "mapping/methods/GaussianMethod.hpp"
#include "mapping/methods/PowerDiagram.hpp"

namespace gimdem
{

template <class Device>
void DeviceMapping<Device>::upload(Device& device, FluidScene const& scene, MeshKernelView const& mesh,
                                   CellBox const* boxes, ParticleState const& particles)
{
    mesh_ = mesh;
    boxes_ = boxes;
    if (scene.mapper.prepare(particles) || layer_cells_.size() == 0) upload_rows(device, scene.mapper);
    // By name: nvcc does not take all of the methods' headers.
    Method& method = scene.mapper.method();
    std::string const& name = scene.settings.mapping.method;
    if (name == "pcm" || name == "diffusion")
        kind_ = Kind::own_cell;
    else if (name == "gim" || name == "gim-fixed")
        kind_ = upload_gaussian(device, static_cast<GaussianMethod&>(method), particles);
    else if (name == "divided")
        kind_ = Kind::points, points_.upload(device, static_cast<DividedVolume&>(method).points());
    else if (name == "fbsi")
        kind_ = Kind::faces;
    else if (name == "kernel")
        kind_ = Kind::kernel, radii_of_kernel_ = static_cast<GaussianKernel&>(method).radii();
    else if (name == "exact")
        kind_ = Kind::overlap, upload_facets(device, static_cast<ExactOverlap&>(method));
    else if (name == "power-diagram")
        kind_ = Kind::potentials, potentials_.upload(device, static_cast<PowerDiagram&>(method).potentials());
    else
        throw UserError("mapping method \"" + name +
                        "\" does not run on a GPU (it has no law in mapping/PairLaws.hpp); set another [mapping] "
                        "method, or run on the processor with --device cpu");
    device.wait();
}

template <class Device>
void DeviceMapping<Device>::upload_rows(Device& device, Mapper const& mapper)
{
    CellRows const& layers = mapper.layers();
    layer_offsets_.upload(device, layers.offsets);
    layer_cells_.upload(device, layers.cells);
    reverse_slot_.upload(device, mapper.reverse_slot());
    std::vector<std::int32_t> row_of(static_cast<std::size_t>(layers.cells.size()));
    for (std::int32_t c = 0; c + 1 < layers.offsets.size(); ++c)
        std::fill(row_of.begin() + layers.offsets[c], row_of.begin() + layers.offsets[c + 1], c);
    row_of_.upload(device, {row_of.data(), row_of.size()});
    device.wait();
}

template <class Device>
typename DeviceMapping<Device>::Kind DeviceMapping<Device>::upload_gaussian(Device& device, GaussianMethod& method,
                                                                            ParticleState const& particles)
{
    cell_sizes_.upload(device, method.cell_sizes());
    fixed_coefficient_ = method.fixed_coefficient();
    GaussianTables& tables = method.tables();
    if (!tables.provide(particles)) return Kind::closed_form;
    table_shape_ = tables.view();
    auto const rows = static_cast<std::size_t>(table_shape_.row_count);
    auto const pairs = rows * static_cast<std::size_t>(table_shape_.cell_count);
    std::int64_t end = 0;
    for (std::size_t k = 0; k < pairs; ++k)
        end = std::max(end, table_shape_.pairs[k].table + GaussianTableView::length);
    radii_.upload(device, {table_shape_.radii, rows});
    pairs_.upload(device, {table_shape_.pairs, pairs});
    coefficients_.upload(device, {table_shape_.coefficients, static_cast<std::size_t>(end)});
    return Kind::tables;
}

template <class Device>
void DeviceMapping<Device>::upload_facets(Device& device, ExactOverlap const& method)
{
    overlap::CellFacets const& from = method.facets();
    corners_at_.upload(device, from.points());
    facet_offsets_.upload(device, from.facet_offsets());
    corner_offsets_.upload(device, from.corner_offsets());
    corners_.upload(device, from.corners());
    facet_normals_.upload(device, from.normals());
    facet_edges_.upload(device, from.edges());
    facets_ = {corners_at_.data(),
               facet_offsets_.data(),
               corner_offsets_.data(),
               corners_.data(),
               facet_edges_.data(),
               facet_normals_.data(),
               boxes_,
               mesh_.cell_offsets,
               mesh_.cell_faces,
               mesh_.owner,
               mesh_.neighbour,
               mesh_.internal_face_count};
}

template <class Device>
template <class Work>
void DeviceMapping<Device>::with_law(Work work) const
{
    switch (kind_)
    {
        case Kind::own_cell:
            return work(WholeOfOwnCell{});
        case Kind::tables:
            return work(TabulatedIntegral1{
                {radii_.data(), pairs_.data(), coefficients_.data(), table_shape_.row_count, table_shape_.cell_count},
                mesh_.cell});
        case Kind::closed_form:
            return work(ClosedFormIntegral1{{cell_sizes_.data(), fixed_coefficient_}, mesh_.cell});
        case Kind::points:
            return work(PointCount1{{mesh_}, boxes_, points_.data(), static_cast<std::int32_t>(points_.size())});
        case Kind::faces:
            return work(SoftIntersection1{mesh_});
        case Kind::kernel:
            return work(GaussianAtCentre1{mesh_.cell, radii_of_kernel_});
        case Kind::overlap:
            return work(Overlap1{facets_});
        case Kind::potentials:
            return work(PowerDiagram1{{potentials_.data()}});
    }
}

}  // namespace gimdem

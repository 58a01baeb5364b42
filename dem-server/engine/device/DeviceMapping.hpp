// SPDX-License-Identifier: BSD-3-Clause
/// The mapping method of the case on a device: candidates of each cell, and the method's law with all that it reads.
#pragma once

#include <cstdint>

#include "engine/device/DeviceDem.hpp"
#include "exec/device/DeviceArray.hpp"
#include "mapping/PairLaws.hpp"
#include "mapping/PairwiseWeights.hpp"

namespace gimdem
{

class ExactOverlap;
class GaussianMethod;

template <class Device>
class DeviceMapping
{
public:
    template <class T>
    using Array = exec::DeviceArray<Device, T>;

    /// After the mesh, and whenever particles of new sizes may have come. `mesh`: on the device. Throws UserError for a
    /// method that devices do not have.
    void upload(Device& device, FluidScene const& scene, MeshKernelView const& mesh, CellBox const* boxes,
                ParticleState const& particles);

    LayerView layers() const
    {
        return {layer_offsets_.data(), layer_cells_.data(), row_of_.data(), reverse_slot_.data()};
    }
    std::int64_t layer_entries() const { return layer_cells_.size(); }

    /// work(law) with the method's law.
    template <class Work>
    void with_law(Work work) const;

private:
    enum class Kind
    {
        own_cell,
        tables,
        closed_form,
        points,
        faces,
        kernel,
        overlap,
        potentials
    };

    void upload_rows(Device& device, Mapper const& mapper);
    Kind upload_gaussian(Device& device, GaussianMethod& method, ParticleState const& particles);
    void upload_facets(Device& device, ExactOverlap const& method);

    Kind kind_ = Kind::own_cell;
    MeshKernelView mesh_{};
    CellBox const* boxes_ = nullptr;
    Array<std::int32_t> layer_offsets_, layer_cells_, row_of_, reverse_slot_;

    // gim, gim-fixed
    GaussianTableView table_shape_{};
    Array<double> radii_, coefficients_;
    Array<TabulatedPair> pairs_;
    Array<CellSize> cell_sizes_;
    double fixed_coefficient_ = 0;
    // divided, kernel, power-diagram
    Array<Quad> points_;
    double radii_of_kernel_ = 0;
    Array<CellPotential> potentials_;
    // exact
    overlap::CellFacetsView facets_{};
    Array<double> corners_at_;
    Array<std::int32_t> facet_offsets_, corner_offsets_, corners_;
    Array<Quad> facet_edges_, facet_normals_;
};

}  // namespace gimdem

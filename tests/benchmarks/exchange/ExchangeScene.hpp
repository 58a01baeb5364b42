// SPDX-License-Identifier: BSD-3-Clause
/// Fields as large as those of a case, with particles in some cells.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gimdem/coupling/CellRuns.hpp"
#include "gimdem/coupling/Types.hpp"

namespace gimdem::bench
{

/// A box of cells whose lowest layers hold particles; smooth fields, as a solver has them.
class Scene
{
public:
    /// cells: in x, y, z. occupied: share of the layers in z that hold particles.
    Scene(std::array<int, 3> cells, double occupied);

    coupling::Mesh mesh() const;
    std::size_t cell_count() const { return count_; }
    coupling::FluidFields fluid() const;
    coupling::SolidFields solid() const;
    /// Of both: the layers with particles and, for the velocity, two more, as the server asks for them.
    coupling::StepCells cells() const;

    /// Bytes of each array of the fluid, and of the solid, as they travel.
    std::vector<std::size_t> fluid_bytes(coupling::Encodings const& encodings) const;
    std::vector<std::size_t> solid_bytes(coupling::Encodings const& encodings) const;

private:
    std::array<int, 3> size_;
    std::size_t count_;
    int layers_;  ///< with particles
    std::vector<double> velocity_, velocity_gradient_, pressure_gradient_, void_fraction_gradient_, pressure_;
    std::vector<double> void_fraction_, drag_coefficient_, drag_momentum_;
};

}  // namespace gimdem::bench

// SPDX-License-Identifier: BSD-3-Clause
/// One mapping method on one mesh: weights of single particles and sums of many.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "SparseWeights.hpp"
#include "TestCase.hpp"
#include "mapping/Mapper.hpp"

namespace gimdem::benchmark
{

class MethodOnMesh
{
public:
    MethodOnMesh(PolyMesh const& mesh, std::string_view method);

    /// Whether cells pass on what they receive.
    bool spreads() const { return spreads_; }

    /// What each sphere would give to each cell if it were alone: a method may spread further what cells have received.
    std::vector<test::SparseRow> weights(std::vector<test::Sphere> const& spheres);

    /// Solid fraction of each cell.
    std::vector<double> solid_fractions(std::vector<test::Sphere> const& spheres);

private:
    void map(ParticleState const& particles);
    bool find_whether_it_spreads();
    test::SparseRow const& spread(test::SparseRow const& row);

    PolyMesh const& mesh_;
    Mapper mapper_;
    exec::Buffer<std::uint8_t> wall_faces_;
    exec::Buffer<Impulse> no_impulses_;
    CellSums sums_;
    bool spreads_;
    std::map<test::SparseRow, test::SparseRow> spread_rows_;  ///< what becomes of a row
};

}  // namespace gimdem::benchmark

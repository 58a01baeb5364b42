// SPDX-License-Identifier: BSD-3-Clause
/// How far a mapping method is from the exact overlap, and how smooth it is: what `./gimdem bench mapping` tabulates.
#pragma once

#include <string_view>
#include <vector>

#include "MappingScene.hpp"
#include "MethodOnMesh.hpp"

namespace gimdem::benchmark
{

/// Centres of the spheres that single-particle measures look at.
class Probes
{
public:
    static constexpr int steps_per_line = 200;  ///< of a hundredth of the diameter

    /// `places` at random in the middle of the scene, and `lines` of random places and directions that stay in it or,
    /// where it is one period of cells, leave it for others like it.
    Probes(MappingScene const& scene, int places, int lines);

    std::vector<test::Sphere> places;
    std::vector<std::vector<test::Sphere>> lines;
};

/// Mean share of a particle's volume that is in the wrong cells, theory.md (G.30).
double wrong_cells(MethodOnMesh& method, MethodOnMesh& exact, Probes const& probes);

struct Jump
{
    double largest = 0;  ///< change of any cell's solid fraction in one step of a line
    double mean = 0;     ///< of the largest changes of all steps
};

Jump void_fraction_jump(MethodOnMesh& method, PolyMesh const& mesh, Probes const& probes);

/// A packing mapped by a method beside the exact solid fractions.
struct PackingErrors
{
    double rms;      ///< deviation from the exact solid fraction, weighted by volume, over the cells of the packing
    double largest;  ///< solid fraction of any cell
    double wall;     ///< mean solid fraction of the cells at walls, over the exact one
};

PackingErrors packing_errors(MappingScene const& scene, Region const& bed, std::vector<double> const& fractions,
                             std::vector<double> const& exact);

}  // namespace gimdem::benchmark

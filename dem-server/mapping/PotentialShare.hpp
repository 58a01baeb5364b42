// SPDX-License-Identifier: BSD-3-Clause
/// What a cell takes of a ball by the potentials of a power diagram, theory.md (G.35), (G.38), (G.39).
#pragma once

#include <cmath>
#include <cstdint>

#include "mapping/CellPotentials.hpp"

namespace gimdem
{

/// Square of how large a ball of the radius r is against a cell.
GIMDEM_HD inline double relative_size2(CellPotential const& cell, double r)
{
    return cell.narrowness * (r * r);
}

/// 1 / (height of a cell's potential beyond which a ball of the radius r does not reach it) [1/m], (G.38): 1/r for a
/// ball that is small against the cell.
GIMDEM_HD inline double per_reach(CellPotential const& cell, double r)
{
    return 1 / (r * std::sqrt(1 + relative_size2(cell, r)));
}

/// Share of a cell whose potential is higher by u, of one whose potential is least, (G.39): for a ball that is small
/// against the cell the ratio of the two parts that a plane at u radii from its centre cuts it into.
GIMDEM_HD inline double odds(double u, double size2)
{
    double const in = (1 - u) * (1 - u) * (2 + u), out = (1 + u) * (1 + u) * (2 - u);
    double const flatness = 3 * size2 * size2;
    return in * (1 + flatness) / (out + flatness * in);
}

struct PotentialShare
{
    CellPotential const* potentials;

    /// Of a cell at the ball's centre [1]: the least of all candidates' is that of the cell which holds it.
    GIMDEM_HD double level(Quad const& particle, std::int32_t c) const
    {
        return potentials[c](particle) * per_reach(potentials[c], particle.w);
    }
    /// Before the weights are normalised; `least`: of the levels of all candidates.
    GIMDEM_HD double share(Quad const& particle, std::int32_t c, double level, double least) const
    {
        double const u = level - least;
        return u < 1 ? odds(u, relative_size2(potentials[c], particle.w)) : 0;
    }
};

}  // namespace gimdem

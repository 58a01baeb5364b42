// SPDX-License-Identifier: BSD-3-Clause
/// Some candidate cells of the particles of one cell, side by side for vector instructions: read once, then used by
/// every particle.
#pragma once

#include <cstdint>

#include "exec/Octet.hpp"
#include "exec/Selection.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// Centres of some candidate cells. Lanes past `count` repeat the first cell.
struct CandidateCentres
{
    static constexpr int most = 32;
    static constexpr int most_octets = most / exec::octet;

    int count;
    std::int32_t cells[most];
    exec::OctetOfQuads centres[most_octets];  ///< [m], w: volume [m^3]

    CandidateCentres(Quad const* cell, std::int32_t const* candidates, int count_) : count(count_)
    {
        for (int k = 0; k < exec::octet * octets(); ++k)
            cells[k] = candidates[k < count ? k : 0];
        for (int j = 0; j < octets(); ++j)
            centres[j] = exec::load(cell, cells + exec::octet * j);
    }

    int octets() const { return (count + exec::octet - 1) / exec::octet; }

    /// Squares of the distances of the j-th eight [m^2].
    exec::Octet distance2(int j, Quad const& p) const
    {
        using exec::Octet;
        using exec::plus_product;
        Octet const dx = p.x - centres[j].x, dy = p.y - centres[j].y, dz = p.z - centres[j].z;
        return plus_product(plus_product(Octet(dx * dx), dy, dy), dz, dz);
    }

    /// Writes the numbers of the j-th eight to their places in a row, and no more.
    void store(int j, exec::Octet const& eight, double* row) const
    {
        int const left = count - exec::octet * j;
        exec::store_first(eight, left < exec::octet ? left : exec::octet, row + exec::octet * j);
    }
};

}  // namespace gimdem

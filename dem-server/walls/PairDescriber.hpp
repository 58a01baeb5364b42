// SPDX-License-Identifier: BSD-3-Clause
/// What is known of particle-wall pairs once they are listed.
#pragma once

#include <cstdint>

#include "walls/WallView.hpp"

namespace gimdem
{

/// Tells what the pairs of one particle are, once they are listed.
struct PairDescriber
{
    WallView walls;
    std::int32_t const* offsets;
    std::int32_t const* plane;
    std::uint8_t const* whole;
    std::int32_t const* material;    ///< of each particle
    std::int32_t const* first_pair;  ///< of each body: the row of its material
    std::int32_t* particle;
    std::int32_t* row;
    std::uint8_t* alone;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        bool const all_alone = are_alone(offsets[i], offsets[i + 1]);
        for (std::int32_t k = offsets[i]; k < offsets[i + 1]; ++k)
        {
            particle[k] = static_cast<std::int32_t>(i);
            row[k] = first_pair[walls.surfaces[plane[k]].body] + material[i];
            alone[k] = all_alone;
        }
    }

private:
    /// Planes at rest that are touched inside or not at all, no two of one patch: none stands for another, and no
    /// spring goes from one to another.
    GIMDEM_HD bool are_alone(std::int32_t begin, std::int32_t end) const
    {
        for (std::int32_t k = begin; k < end; ++k)
        {
            WallSurface const& s = walls.surfaces[plane[k]];
            if (whole[k] == 0 || s.kind == SurfaceKind::cylinder || s.two_sided || walls.bodies[s.body].moves)
                return false;
            for (std::int32_t m = begin; m < k; ++m)
                if (walls.surfaces[plane[m]].patch == s.patch) return false;
        }
        return true;
    }
};

}  // namespace gimdem

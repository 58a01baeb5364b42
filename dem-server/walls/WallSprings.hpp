// SPDX-License-Identifier: BSD-3-Clause
/// The springs of particle-wall contacts follow their contact over the seams of a wall, theory.md (D.54).
#pragma once

#include <cmath>

#include "walls/WallTouches.hpp"

namespace gimdem
{

/// What the contacts of pairs of a particle and a surface remember. The w of a tangential spring is scratch.
struct WallSprings
{
    Quad* tangential;  ///< of each pair [m]
    Quad* rolling;     ///< of each pair [N m]; null where the law has none

    GIMDEM_HD void drop(std::int32_t k) const
    {
        tangential[k] = {0, 0, 0, 0};
        if (rolling != nullptr) rolling[k] = {0, 0, 0, 0};
    }

    GIMDEM_HD bool are_slack(std::int32_t k) const
    {
        return tangential[k].xyz().isZero(0) && (rolling == nullptr || rolling[k].xyz().isZero(0));
    }

    /// Takes over what pair `from` remembers.
    GIMDEM_HD void take(std::int32_t k, std::int32_t from) const
    {
        tangential[k].set_xyz(tangential[from].xyz());
        if (rolling != nullptr) rolling[k] = rolling[from];
    }
};

/// Moves the springs of one particle, whose pairs are [begin, end).
struct SpringMover
{
    WallTouches walls;
    WallSprings springs;
    std::int32_t begin, end;

    /// A contact that comes over from another plane of its patch, or from the same edge, brings its springs along;
    /// planes that are no longer touched lose theirs.
    GIMDEM_HD void operator()(Touch const* touches, std::int32_t count) const
    {
        Quad* const spring = springs.tangential;
        for (std::int32_t t = 0; t < count; ++t)
            if (touches[t].counts) spring[touches[t].pair].w = 1;
        for (std::int32_t t = 0; t < count; ++t)
        {
            std::int32_t const k = touches[t].pair;
            if (!touches[t].counts || !springs.are_slack(k)) continue;
            std::int32_t const from = giver(touches, count, t);
            if (from >= 0) springs.take(k, from);
        }
        for (std::int32_t k = begin; k < end; ++k)
            if (spring[k].w == 0)
                springs.drop(k);
            else
                spring[k].w = 0;
    }

private:
    /// Pair whose springs touch t takes over: one that touches no more, most nearly in the same plane; or -1.
    GIMDEM_HD std::int32_t giver(Touch const* touches, std::int32_t count, std::int32_t t) const
    {
        WallSurface const* const surfaces = walls.nearby.walls.surfaces;
        WallSurface const& own = surfaces[touches[t].surface];
        std::int32_t best = -1;
        double best_cosine = 0.5;  // two smooth seams at most lie between
        for (std::int32_t k = begin; k < end; ++k)
        {
            if (springs.tangential[k].w != 0 || springs.are_slack(k)) continue;
            WallSurface const& other = surfaces[walls.plane[k]];
            double cosine = own.normal.xyz().dot(other.normal.xyz());
            if (own.two_sided) cosine = std::abs(cosine);
            if (other.patch != own.patch) cosine = shares_point(touches, count, t, k) ? 1 : 0;
            if (cosine <= best_cosine) continue;
            best = k;
            best_cosine = cosine;
        }
        return best;
    }

    /// Whether pair k touches the particle too, as a part of touch t.
    GIMDEM_HD bool shares_point(Touch const* touches, std::int32_t count, std::int32_t t, std::int32_t k) const
    {
        for (std::int32_t u = 0; u < count; ++u)
            if (touches[u].pair == k)
                return (touches[u].point.vec() - touches[t].point.vec()).norm() <= 1e-3 * touches[t].overlap;
        return false;
    }
};

}  // namespace gimdem

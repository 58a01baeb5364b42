// SPDX-License-Identifier: BSD-3-Clause
/// Kernels that list the walls near each particle and carry the springs of the list before.
#pragma once

#include <cstdint>

#include "walls/NearbyWalls.hpp"

namespace gimdem
{

/// Finds the surfaces near a particle: first counts them, then, with `plane` set, lists them.
struct PairLister
{
    NearbyWalls nearby;
    Quad const* position;
    double skin;
    std::int32_t* offsets;  ///< counts while counting
    std::uint64_t* seen;    ///< of each particle: two bits for each of its first runs, near and whole
    std::int32_t* plane;
    std::uint8_t* whole;

    static constexpr int most_runs = 32;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        if (plane == nullptr)
            count(i);
        else if (offsets[i] != offsets[i + 1])
            list(i);
    }

private:
    static constexpr std::uint64_t is_near = 1, is_whole = 2;

    GIMDEM_HD void count(std::int64_t i) const
    {
        Quad const x = position[i];
        std::uint64_t bits = 0;
        std::int32_t found = 0;
        int r = 0;
        nearby(x.xyz(),
               [&](Vec3 const& y, SurfaceRun const& run)
               {
                   std::uint64_t const here = look(run, y, x.w);
                   found += (here & is_near) != 0;
                   if (r < most_runs) bits |= here << (2 * r);
                   ++r;
               });
        seen[i] = bits;
        offsets[i] = found;
    }

    GIMDEM_HD void list(std::int64_t i) const
    {
        Quad const x = position[i];
        std::int32_t k = offsets[i];
        int r = 0;
        nearby(x.xyz(),
               [&](Vec3 const& y, SurfaceRun const& run)
               {
                   std::uint64_t const here = r < most_runs ? seen[i] >> (2 * r) : look(run, y, x.w);
                   ++r;
                   if ((here & is_near) == 0) return;
                   plane[k] = run.surface;
                   whole[k++] = (here & is_whole) != 0;
               });
    }

    GIMDEM_HD std::uint64_t look(SurfaceRun const& run, Vec3 const& y, double radius) const
    {
        double const reach = radius + skin;
        WallSurface const& s = nearby.walls.surfaces[run.surface];
        if (s.kind == SurfaceKind::cylinder)
            return NearbyWalls::closest_on_cylinder(s, y).distance > reach ? 0 : is_near;
        double const height = s.normal.xyz().dot(y) - s.normal.w;
        if (height > reach || height < -reach) return 0;
        if (s.kind == SurfaceKind::plane) return is_near | is_whole;
        SurfacePoint const at = nearby.closest(run, y);
        if (at.distance > reach) return 0;
        return is_near | (at.interior && nearby.distance_to_rim(run, at.point) > 2 * skin ? is_whole : 0);
    }
};

struct WallSpringCarrier
{
    std::int32_t const* order;  ///< null: particles kept their places
    std::int32_t const* offsets;
    std::int32_t const* plane;
    std::int32_t const* old_offsets;
    std::int32_t const* old_plane;
    Quad const* old_spring;
    Quad* spring;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int64_t const old = order == nullptr ? i : order[i];
        for (std::int32_t k = offsets[i]; k < offsets[i + 1]; ++k)
        {
            spring[k] = {0, 0, 0, 0};
            for (std::int32_t m = old_offsets[old]; m < old_offsets[old + 1]; ++m)
                if (old_plane[m] == plane[k]) spring[k] = old_spring[m];
        }
    }
};

}  // namespace gimdem

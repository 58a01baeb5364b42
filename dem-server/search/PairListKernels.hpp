// SPDX-License-Identifier: BSD-3-Clause
/// Kernels that build the list of pairs: count, fill, carry the springs of the list before, theory.md (D.72).
#pragma once

#include <cstdint>

#include "exec/Vector.hpp"

namespace gimdem
{

/// True for particles closer than the sum of their radii + skin, or than that to an image of each other.
template <class Space>
struct Nearness
{
    Quad const* position;
    double skin;
    Space space;

    GIMDEM_HD bool operator()(std::int64_t i, std::int64_t j) const
    {
        double const reach = position[i].w + position[j].w + skin;
        Vec3 between = position[i].xyz() - position[j].xyz();
        space.shorten(between.x(), between.y(), between.z());
        return between.squaredNorm() < reach * reach;
    }
};

/// Number of pairs of each particle as the first member.
template <class Candidates, class Near>
struct PairCounter
{
    Candidates visit_candidates;
    Near near;
    std::int32_t* counts;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int32_t count = 0;
        visit_candidates(i, [&](std::int64_t j) { count += near(i, j); });
        counts[i] = count;
    }
};

/// Where the first particles of pairs go: numbers of their own.
struct FirstAsNumber
{
    std::int32_t* first;

    GIMDEM_HD void set(std::int32_t pair, std::int64_t i) const { first[pair] = static_cast<std::int32_t>(i); }
};

template <class Candidates, class Near, class First = FirstAsNumber>
struct PairFiller
{
    Candidates visit_candidates;
    Near near;
    std::int32_t const* offsets;
    First first;
    std::int32_t* second;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int32_t k = offsets[i];
        visit_candidates(i,
                         [&](std::int64_t j)
                         {
                             if (!near(i, j)) return;
                             first.set(k, i);
                             second[k++] = static_cast<std::int32_t>(j);
                         });
    }
};

/// Finds the spring of a pair in the old list, whose particles had other numbers; a swapped pair changes its sign.
struct SpringCarrier
{
    std::int32_t const* first;
    std::int32_t const* second;
    std::int32_t const* old_place;
    std::int32_t const* old_offsets;
    std::int32_t const* old_second;
    Quad const* old_displacement;
    Quad* displacement;

    GIMDEM_HD void operator()(std::int64_t k) const
    {
        std::int32_t const i = old_place[first[k]];
        std::int32_t const j = old_place[second[k]];
        std::int32_t const low = i < j ? i : j;
        std::int32_t const high = i < j ? j : i;
        displacement[k] = {0, 0, 0, 0};
        for (std::int32_t old = old_offsets[low]; old < old_offsets[low + 1]; ++old)
            if (old_second[old] == high)
            {
                Vec3 const spring = old_displacement[old].xyz();
                displacement[k] = Quad::of(i == low ? spring : Vec3(-spring), 0);
            }
    }
};

}  // namespace gimdem

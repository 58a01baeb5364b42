// SPDX-License-Identifier: BSD-3-Clause
#include "search/SizeLevels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/Error.hpp"
#include "exec/Reduce.hpp"

namespace gimdem
{

namespace
{

[[noreturn]] void fail_not_finite(ParticleState const& particles)
{
    std::int64_t i = 0;
    while (particles.position[i].xyz().allFinite())
        ++i;
    throw UserError(
        fmt::format("particle {} has no finite position (the motion diverged); reduce [dem] "
                    "time_step or check the materials",
                    particles.id[i]));
}

/// Of two sets of particles together.
SizeCensus operator+(SizeCensus a, SizeCensus const& b)
{
    for (int k = 0; k < SizeCensus::most; ++k)
    {
        a.count[k] += b.count[k];
        a.largest[k] = std::max(a.largest[k], b.largest[k]);
    }
    return a;
}

/// The box of all centres, or that of the domain where it is periodic.
std::pair<Vec3, Vec3> box_of(Extent const& extent, Domain const& domain)
{
    Vec3 low = extent.low.vec(), high = extent.high.vec();
    Vec3 const period = domain.period.vec(), domain_low = domain.low.vec();
    for (int axis = 0; axis < 3; ++axis)
        if (period[axis] > 0)
        {
            low[axis] = domain_low[axis];
            high[axis] = domain_low[axis] + period[axis];
        }
    return {low, high};
}

}  // namespace

Extent Extent::of(exec::Execution const& execution, ParticleState const& particles)
{
    if (particles.count() == 0) return {{0, 0, 0}, {0, 0, 0}, 0, 0};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    struct Part
    {
        Extent extent;
        bool finite;
    };
    Quad const* const position = particles.position.view().data;
    Part const all = exec::reduce(
        execution, particles.count(),
        Part{{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, 0, infinity}, true},
        [=](std::int64_t i)
        {
            Vec3 const x = position[i].xyz();
            return Part{{constant3(x), constant3(x), position[i].w, position[i].w}, x.allFinite()};
        },
        [](Part const& a, Part const& b)
        {
            return Part{{constant3(a.extent.low.vec().cwiseMin(b.extent.low.vec())),
                         constant3(a.extent.high.vec().cwiseMax(b.extent.high.vec())),
                         std::max(a.extent.largest_radius, b.extent.largest_radius),
                         std::min(a.extent.smallest_radius, b.extent.smallest_radius)},
                        a.finite && b.finite};
        });
    if (!all.finite) fail_not_finite(particles);
    return all.extent;
}

SizeCensus SizeCensus::of(exec::Execution const& execution, ParticleState const& particles, Extent const& extent)
{
    SizeCensus one_size;
    one_size.count[0] = particles.count();
    one_size.largest[0] = extent.largest_radius;
    if (2 * extent.smallest_radius > extent.largest_radius) return one_size;

    Quad const* const position = particles.position.view().data;
    constexpr std::int64_t block = 1024;
    std::int64_t const n = particles.count();
    return exec::reduce(
        execution, (n + block - 1) / block, SizeCensus{},
        [=](std::int64_t b)
        {
            SizeCensus census;
            for (std::int64_t i = b * block; i < std::min(n, (b + 1) * block); ++i)
            {
                int const k = SizeLevels::halvings(position[i].w, extent.largest_radius);
                ++census.count[k];
                census.largest[k] = std::max(census.largest[k], position[i].w);
            }
            return census;
        },
        [](SizeCensus const& a, SizeCensus const& b) { return a + b; });
}

SizeLevels SizeLevels::of(exec::Execution const& execution, ParticleState const& particles, Extent const& extent,
                          double skin, Domain const& domain)
{
    return of(SizeCensus::of(execution, particles, extent), extent, skin, domain);
}

SizeLevels SizeLevels::of(SizeCensus const& census, Extent const& extent, double skin, Domain const& domain)
{
    auto const [low, high] = box_of(extent, domain);
    SizeLevels levels;
    levels.largest_radius = extent.largest_radius;
    std::int64_t particles_so_far = 0;
    for (int k = most - 1; k >= 0; --k)
    {
        if (census.count[k] == 0 && k > 0) continue;
        SizeLevel& level = levels.level[levels.count];
        level.grid = CellGrid::over(low, high, 2 * census.largest[k] + skin, 8 * census.count[k] + 1000, domain.period);
        level.first_cell = levels.cell_count;
        level.first_particle = static_cast<std::int32_t>(particles_so_far);
        level.largest_radius = census.largest[k];
        levels.level_of[k] = static_cast<std::int8_t>(levels.count++);
        levels.cell_count += static_cast<std::int32_t>(level.grid.count());
        particles_so_far += census.count[k];
    }
    return levels;
}

}  // namespace gimdem

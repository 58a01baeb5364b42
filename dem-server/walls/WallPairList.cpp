// SPDX-License-Identifier: BSD-3-Clause
/// Which walls each particle may soon touch, and for how long that holds.
#include <algorithm>
#include <limits>

#include "exec/ForEach.hpp"
#include "exec/Sort.hpp"
#include "walls/ApproachBound.hpp"
#include "walls/PairDescriber.hpp"
#include "walls/WallContacts.hpp"
#include "walls/WallListKernels.hpp"

namespace gimdem
{

void WallContacts::build(ParticleState const& particles, double skin, std::span<std::int32_t const> order)
{
    std::int64_t const n = particles.count();
    bool const has_springs = pairs_.offsets.size() == n + 1;
    swap(old_.offsets, pairs_.offsets);
    swap(old_.plane, pairs_.plane);
    swap(old_.displacement, pairs_.displacement);
    swap(old_.rolling_spring, pairs_.rolling_spring);

    pairs_.offsets.resize(n + 1);
    seen_.resize(n);
    PairLister lister{
        nearby(), particles.position.view().data, skin, pairs_.offsets.view().data, seen_.view().data, nullptr,
        nullptr};
    exec::for_each(execution_, n, lister);
    std::int32_t most = 0;
    for (std::int64_t i = 0; i < n; ++i)
        most = std::max(most, pairs_.offsets[i]);
    std::int64_t const count = exec::exclusive_scan(pairs_.offsets.host());
    for (auto* const numbers : {&pairs_.plane, &pairs_.particle, &pairs_.row})
        numbers->resize(count);
    pairs_.whole.resize(count);
    pairs_.alone.resize(count);
    force_.resize(count);
    force_.fill({0, 0, 0, 1});
    pairs_.displacement.resize(count);
    pairs_.rolling_spring.resize(model_.has_rolling_spring() ? count : 0);
    touches_.resize(most > WallTouches::most_at_hand ? count : 0);
    lister.plane = pairs_.plane.view().data;
    lister.whole = pairs_.whole.view().data;
    exec::for_each(execution_, n, lister);
    exec::for_each(execution_, n,
                   PairDescriber{walls_.view(), pairs_.offsets.view().data, pairs_.plane.view().data,
                                 pairs_.whole.view().data, particles.material.view().data, first_pair_.view().data,
                                 pairs_.particle.view().data, pairs_.row.view().data, pairs_.alone.view().data});

    if (has_springs)
        carry_springs(order, old_.displacement, pairs_.displacement);
    else
        pairs_.displacement.fill({0, 0, 0, 0});
    if (has_springs && model_.has_rolling_spring())
        carry_springs(order, old_.rolling_spring, pairs_.rolling_spring);
    else
        pairs_.rolling_spring.fill({0, 0, 0, 0});
    remember_build(particles, skin);
}

void WallContacts::carry_springs(std::span<std::int32_t const> order, exec::Buffer<Quad> const& old_spring,
                                 exec::Buffer<Quad>& spring)
{
    exec::for_each(execution_, pairs_.offsets.size() - 1,
                   WallSpringCarrier{order.empty() ? nullptr : order.data(), pairs_.offsets.view().data,
                                     pairs_.plane.view().data, old_.offsets.view().data, old_.plane.view().data,
                                     old_spring.view().data, spring.view().data});
}

void WallContacts::remember_build(ParticleState const& particles, double skin)
{
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    if (some_wall_moves_)
        for (Quad const& x : particles.position.host())
        {
            Vec3 const reach = Vec3::Constant(x.w + skin);
            low = low.cwiseMin(x.xyz() - reach);
            high = high.cwiseMax(x.xyz() + reach);
        }
    remember_build(low, high);
}

void WallContacts::remember_build(Vec3 const& low, Vec3 const& high)
{
    built_at_ = poses_;
    built_time_ = time_;
    low_ = low;
    high_ = high;
}

bool WallContacts::is_stale(double skin) const
{
    if (!some_wall_moves_ || built_at_.size() == 0 || !(low_.x() <= high_.x())) return false;
    WallView const walls = walls_.view();
    for (std::int32_t b = 0; b < walls.body_count; ++b)
    {
        WallBody const& body = walls.bodies[b];
        if (!body.moves) continue;
        ApproachBound const approach(built_at_[b], poses_[b]);
        double const moved = body.has_triangles ? approach.of_box(body.low.vec(), body.high.vec())
                                                : approach.of(walls.surfaces[body.surface], low_, high_);
        if (!(2 * moved <= skin)) return true;
    }
    return false;
}

void WallContacts::move_to(double time)
{
    time_ = time;
    for (std::int32_t b = 0; b < walls_.body_count(); ++b)
        if (walls_.motion(b).moves()) poses_[b] = walls_.motion(b).at(time);
}

}  // namespace gimdem

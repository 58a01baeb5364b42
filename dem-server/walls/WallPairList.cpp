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

namespace
{

/// What of the list before is needed for the springs, while a new one takes its place.
struct OldWallPairs
{
    std::int32_t* offsets;
    std::int32_t* plane;
    Quad* displacement;
    Quad* rolling_spring;

    OldWallPairs(WallPairs const& pairs, exec::Room& room)
        : offsets(copy(pairs.offsets, room)),
          plane(copy(pairs.plane, room)),
          displacement(copy(pairs.displacement, room)),
          rolling_spring(copy(pairs.rolling_spring, room))
    {
    }

    /// Fills one kind of spring of the new list. order: the permutation since the old one, empty: none.
    void carry(exec::Execution const& execution, std::span<std::int32_t const> order, WallPairs const& pairs,
               Quad const* old_spring, exec::Buffer<Quad>& spring) const
    {
        exec::for_each(execution, pairs.offsets.size() - 1,
                       WallSpringCarrier{order.empty() ? nullptr : order.data(), pairs.offsets.view().data,
                                         pairs.plane.view().data, offsets, plane, old_spring, spring.view().data});
    }

private:
    template <class T>
    static T* copy(exec::Buffer<T> const& from, exec::Room& room)
    {
        T* const to = room.take<T>(from.size());
        std::copy_n(from.view().data, from.size(), to);
        return to;
    }
};

}  // namespace

void WallContacts::build(ParticleState const& particles, double skin, std::span<std::int32_t const> order)
{
    exec::Room room;
    build(particles, skin, order, room);
}

void WallContacts::build(ParticleState const& particles, double skin, std::span<std::int32_t const> order,
                         exec::Room& room)
{
    std::int64_t const n = particles.count();
    bool const has_springs = pairs_.offsets.size() == n + 1;
    OldWallPairs const old(pairs_, room);

    pairs_.offsets.resize(n + 1);
    PairLister lister{nearby(),
                      particles.position.view().data,
                      skin,
                      pairs_.offsets.view().data,
                      room.take<std::uint64_t>(n),
                      nullptr,
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
        old.carry(execution_, order, pairs_, old.displacement, pairs_.displacement);
    else
        pairs_.displacement.fill({0, 0, 0, 0});
    if (has_springs && model_.has_rolling_spring())
        old.carry(execution_, order, pairs_, old.rolling_spring, pairs_.rolling_spring);
    else
        pairs_.rolling_spring.fill({0, 0, 0, 0});
    remember_build(particles, skin);
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

// SPDX-License-Identifier: BSD-3-Clause
/// Which walls each particle may soon touch, and for how long that holds.
#include <algorithm>
#include <limits>

#include "exec/ForEach.hpp"
#include "exec/Sort.hpp"
#include "walls/WallContacts.hpp"
#include "walls/WallListKernels.hpp"

namespace gimdem
{

namespace
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

/// Calls visit(corner) for the eight corners of a box.
template <class Visit>
void visit_corners(Vec3 const& low, Vec3 const& high, Visit&& visit)
{
    for (int corner = 0; corner < 8; ++corner)
        visit(Vec3((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                   (corner & 4) != 0 ? high.z() : low.z()));
}

/// How far a surface may have come nearer to any point of a box, between two poses [m], theory.md (D.56).
class ApproachBound
{
public:
    ApproachBound(WallPose const& then, WallPose const& now) : then_(then), now_(now) {}

    /// Any surface within [low, high] of the body frame.
    double of_box(Vec3 const& low, Vec3 const& high) const
    {
        double most = 0;
        visit_corners(low, high,
                      [&](Vec3 const& y) { most = std::max(most, (now_.to_space(y) - then_.to_space(y)).norm()); });
        return most;
    }

    /// An infinite plane or a tube, near points of [low, high] in space.
    double of(WallSurface const& s, Vec3 const& low, Vec3 const& high) const
    {
        return s.kind == SurfaceKind::plane ? of_plane(s, low, high) : of_tube(s, low, high);
    }

private:
    /// The signed distance is affine in space: its change is largest in a corner.
    double of_plane(WallSurface const& s, Vec3 const& low, Vec3 const& high) const
    {
        double most = 0;
        visit_corners(low, high,
                      [&](Vec3 const& x) {
                          most = std::max(most, std::abs(s.normal.xyz().dot(now_.to_body(x)) -
                                                         s.normal.xyz().dot(then_.to_body(x))));
                      });
        return most;
    }

    /// The axis, as far as the box sees it: motion along itself changes nothing, unless the tube has ends.
    double of_tube(WallSurface const& s, Vec3 const& low, Vec3 const& high) const
    {
        Vec3 const axis = s.normal.xyz(), start = s.point.xyz();
        double first = std::numeric_limits<double>::infinity(), last = -first;
        visit_corners(low, high,
                      [&](Vec3 const& x)
                      {
                          for (WallPose const* pose : {&then_, &now_})
                          {
                              double const along = axis.dot(pose->to_body(x) - start);
                              first = std::min(first, along);
                              last = std::max(last, along);
                          }
                      });
        double most = 0;
        for (double const along : {first, last})
        {
            Vec3 const moved = now_.to_space(start + along * axis) - then_.to_space(start + along * axis);
            for (WallPose const* pose : {&then_, &now_})
            {
                Vec3 const a = pose->turn(axis);
                most = std::max(most, s.endless ? (moved - moved.dot(a) * a).norm() : moved.norm());
            }
        }
        return most;
    }

    WallPose const& then_;
    WallPose const& now_;
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

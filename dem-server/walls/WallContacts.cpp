// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallContacts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/Error.hpp"
#include "exec/Reduce.hpp"
#include "exec/Sort.hpp"
#include "walls/Triangle.hpp"

namespace gimdem
{

namespace
{

/// Closest point of one plane's triangles near x.
struct PlanePoint
{
    Vec3 point;
    double distance;
    bool interior;  ///< inside the plane, not on its rim
};

/// The run of triangles of one plane in the list of a grid cell, from `begin`.
struct PlaneRun
{
    std::int32_t plane, begin, end;
};

/// Looks at the triangles around a point, one plane after the other.
struct NearbyPlanes
{
    WallView walls;

    /// Calls visit(run) for every plane that has triangles within reach of x.
    template <class Visit>
    GIMDEM_HD void operator()(Vec3 const& x, Visit&& visit) const
    {
        std::int32_t const cell = walls.grid.cell_of(x);
        std::int32_t const end = walls.grid_offsets[cell + 1];
        for (std::int32_t k = walls.grid_offsets[cell]; k < end;)
        {
            PlaneRun run{triangle(k).plane, k, k};
            while (run.end < end && triangle(run.end).plane == run.plane)
                ++run.end;
            visit(run);
            k = run.end;
        }
    }

    GIMDEM_HD WallTriangle const& triangle(std::int32_t k) const { return walls.triangles[walls.grid_triangles[k]]; }

    GIMDEM_HD PlanePoint closest(PlaneRun const& run, Vec3 const& x) const
    {
        PlanePoint best{x, 1e300, false};
        for (std::int32_t k = run.begin; k < run.end; ++k)
        {
            WallTriangle const& t = triangle(k);
            ClosestPoint const here = closest_on_triangle(t.a.xyz(), t.b.xyz(), t.c.xyz(), x);
            double const distance = (here.point - x).norm();
            if (here.interior) return {here.point, distance, true};
            if (distance < best.distance) best = {here.point, distance, false};
        }
        // A point on a seam between triangles is inside the plane, unless the seam is its rim.
        best.interior = distance_to_rim(run, best.point) > 1e-9 * best.distance;
        return best;
    }

    GIMDEM_HD double distance_to_rim(PlaneRun const& run, Vec3 const& point) const
    {
        double least = 1e300;
        for (std::int32_t k = run.begin; k < run.end; ++k)
        {
            WallTriangle const& t = triangle(k);
            if (!t.rim) continue;
            double const distance = (closest_on_segment(t.a.xyz(), t.b.xyz(), point) - point).norm();
            if (distance < least) least = distance;
        }
        return least;
    }
};

/// Finds the planes near a particle: first counts them, then, with `plane` set, lists them.
struct PairLister
{
    NearbyPlanes nearby;
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
               [&](PlaneRun const& run)
               {
                   std::uint64_t const here = look(run, x);
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
               [&](PlaneRun const& run)
               {
                   std::uint64_t const here = r < most_runs ? seen[i] >> (2 * r) : look(run, x);
                   ++r;
                   if ((here & is_near) == 0) return;
                   plane[k] = run.plane;
                   whole[k++] = (here & is_whole) != 0;
               });
    }

    GIMDEM_HD std::uint64_t look(PlaneRun const& run, Quad const& x) const
    {
        double const reach = x.w + skin;
        Quad const p = nearby.walls.plane_normal[run.plane];
        double const height = p.xyz().dot(x.xyz()) - p.w;
        if (height > reach || height < -reach) return 0;
        PlanePoint const at = nearby.closest(run, x.xyz());
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
    Quad const* old_displacement;
    Quad* displacement;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int64_t const old = order == nullptr ? i : order[i];
        for (std::int32_t k = offsets[i]; k < offsets[i + 1]; ++k)
        {
            displacement[k] = {0, 0, 0, 0};
            for (std::int32_t m = old_offsets[old]; m < old_offsets[old + 1]; ++m)
                if (old_plane[m] == plane[k]) displacement[k] = old_displacement[m];
        }
    }
};

/// One touching plane of a particle.
struct Touch
{
    std::int32_t pair;
    bool interior;
    Vec3 point;
    Vec3 normal;  ///< towards the particle
    double overlap;
};

/// All walls of one particle. An edge or corner that two planes share is touched once: planes touched in their interior
/// come first, and a rim point that an earlier plane has already is dropped.
template <class Law>
struct WallKernel
{
    ParticleView particles;
    NearbyPlanes nearby;
    std::int32_t const* offsets;
    std::int32_t const* plane;
    std::uint8_t const* whole;
    typename Law::template Constants<double> const* constants;  ///< row of the wall's material
    double dt;
    Quad* displacement;
    Quad* rolling_spring;  ///< null where the law has none
    Quad* wall_force;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        wall_force[i] = {0, 0, 0, 0};
        if (offsets[i] == offsets[i + 1]) return;
        Touch touches[WallContacts::most_planes];
        int const count = find_touches(i, touches);

        Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
        int kept = 0;
        for (int pass = 0; pass < 2; ++pass)
            for (int t = 0; t < count; ++t)
            {
                if (touches[t].interior != (pass == 0)) continue;
                if (pass == 1 && is_shared(touches, count, t)) continue;
                add(i, touches[t], force, torque);
                ++kept;
            }
        particles.force[i].set_xyz(particles.force[i].xyz() + force);
        particles.torque[i].set_xyz(particles.torque[i].xyz() + torque);
        wall_force[i] = Quad::of(force, kept);
    }

private:
    GIMDEM_HD int find_touches(std::int64_t i, Touch* touches) const
    {
        Quad const x = particles.position[i];
        int count = 0;
        bool needs_triangles = false;
        for (std::int32_t k = offsets[i]; k < offsets[i + 1]; ++k)
        {
            needs_triangles |= whole[k] == 0;
            Quad const p = nearby.walls.plane_normal[plane[k]];
            double const height = p.xyz().dot(x.xyz()) - p.w;
            if (whole[k] != 0 && height < x.w)
                touches[count++] = {k, true, x.xyz() - height * p.xyz(), p.xyz(), x.w - height};
            else
                displacement[k].w = 1;  // not touching so far: marks a spring to be dropped
        }
        if (needs_triangles)
            nearby(x.xyz(),
                   [&](PlaneRun const& run)
                   {
                       for (std::int32_t k = offsets[i]; k < offsets[i + 1]; ++k)
                           if (plane[k] == run.plane && whole[k] == 0) touch_triangles(run, k, x, touches, count);
                   });
        for (std::int32_t k = offsets[i]; k < offsets[i + 1]; ++k)
            if (displacement[k].w != 0) drop_springs(k);
        return count;
    }

    GIMDEM_HD void drop_springs(std::int32_t k) const
    {
        displacement[k] = {0, 0, 0, 0};
        if constexpr (Law::has_rolling_spring) rolling_spring[k] = {0, 0, 0, 0};
    }

    GIMDEM_HD void touch_triangles(PlaneRun const& run, std::int32_t k, Quad const& x, Touch* touches, int& count) const
    {
        PlanePoint const at = nearby.closest(run, x.xyz());
        Vec3 const into = nearby.walls.plane_normal[run.plane].xyz();
        double const side = (x.xyz() - at.point).dot(into);
        if (at.interior)
        {
            if (at.distance >= x.w && side > 0) return;
            if (side < -x.w) return;
            touches[count++] = {k, true, at.point, into, x.w - side};
        }
        else
        {
            if (at.distance >= x.w || at.distance <= 0) return;
            touches[count++] = {k, false, at.point, (x.xyz() - at.point) / at.distance, x.w - at.distance};
        }
        displacement[k].w = 0;
    }

    GIMDEM_HD bool is_shared(Touch const* touches, int count, int t) const
    {
        for (int other = 0; other < count; ++other)
        {
            if (other == t || (!touches[other].interior && other > t)) continue;
            double const near = 1e-6 * touches[t].overlap + 1e-12;
            if ((touches[other].point - touches[t].point).squaredNorm() <= near * near)
            {
                drop_springs(touches[t].pair);
                return true;
            }
        }
        return false;
    }

    GIMDEM_HD void add(std::int64_t i, Touch const& touch, Vec3& force, Vec3& torque) const
    {
        Quad const v = particles.velocity[i];
        double const radius = particles.position[i].w;
        double const lever = radius - touch.overlap / 2;
        Quad const spin = particles.angular_velocity[i];
        ContactGeometry<double> const contact{.normal = vector3(touch.normal),
                                              .overlap = touch.overlap,
                                              .velocity = vector3(v.xyz() - lever * spin.xyz().cross(touch.normal)),
                                              .radius_eff = radius,
                                              .mass_eff = 1 / v.w,
                                              .spin = vector3(spin.xyz()),
                                              .inverse_inertia = spin.w,
                                              .per_distance = 0};
        ContactSprings<double> springs{vector3(displacement[touch.pair].xyz())};
        if constexpr (Law::has_rolling_spring) springs.rolling = vector3(rolling_spring[touch.pair].xyz());
        ContactForce<double> const result =
            Law::template apply<double>(constants[particles.material[i]], dt, contact, springs);
        displacement[touch.pair] = Quad::of(vec3(springs.tangential), 0);
        if constexpr (Law::has_rolling_spring) rolling_spring[touch.pair] = Quad::of(vec3(springs.rolling), 0);
        force += vec3(result.force);
        torque -= lever * touch.normal.cross(vec3(result.tangential));
        if constexpr (Law::rolls) torque += vec3(result.rolling);
    }
};

}  // namespace

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
        {walls_.view()}, particles.position.view().data, skin, pairs_.offsets.view().data, seen_.view().data, nullptr,
        nullptr};
    exec::for_each(execution_, n, lister);
    for (std::int64_t i = 0; i < n; ++i)
        if (pairs_.offsets[i] > most_planes)
            throw UserError(
                fmt::format("particle {} is near {} wall planes (at most {} are held); the walls' faces are "
                            "far smaller than the particle: coarsen the mesh at the walls",
                            particles.id[i], pairs_.offsets[i], most_planes));
    std::int64_t const count = exec::exclusive_scan(pairs_.offsets.host());
    pairs_.plane.resize(count);
    pairs_.whole.resize(count);
    pairs_.displacement.resize(count);
    pairs_.rolling_spring.resize(model_.has_rolling_spring() ? count : 0);
    lister.plane = pairs_.plane.view().data;
    lister.whole = pairs_.whole.view().data;
    exec::for_each(execution_, n, lister);

    if (has_springs)
        carry_springs(order, old_.displacement, pairs_.displacement);
    else
        pairs_.displacement.fill({0, 0, 0, 0});
    if (has_springs && model_.has_rolling_spring())
        carry_springs(order, old_.rolling_spring, pairs_.rolling_spring);
    else
        pairs_.rolling_spring.fill({0, 0, 0, 0});
}

void WallContacts::carry_springs(std::span<std::int32_t const> order, exec::Buffer<Quad> const& old_spring,
                                 exec::Buffer<Quad>& spring)
{
    exec::for_each(execution_, pairs_.offsets.size() - 1,
                   WallSpringCarrier{order.empty() ? nullptr : order.data(), pairs_.offsets.view().data,
                                     pairs_.plane.view().data, old_.offsets.view().data, old_.plane.view().data,
                                     old_spring.view().data, spring.view().data});
}

void WallContacts::add_forces(ParticleState& particles, double dt)
{
    wall_force_.resize(particles.count());
    model_.visit(
        [&]<class Law>(LawTable<Law> const& table)
        {
            exec::for_each(execution_, particles.count(),
                           WallKernel<Law>{particles.view(),
                                           {walls_.view()},
                                           pairs_.offsets.view().data,
                                           pairs_.plane.view().data,
                                           pairs_.whole.view().data,
                                           table.constants.view().data + wall_material_ * material_count_,
                                           dt,
                                           pairs_.displacement.view().data,
                                           pairs_.rolling_spring.view().data,
                                           wall_force_.view().data});
        });
    Quad const* const force = wall_force_.view().data;
    total_force_ = exec::reduce(
        execution_, wall_force_.size(), Quad{0, 0, 0, 0}, [=](std::int64_t i) { return force[i]; },
        [](Quad const& a, Quad const& b) { return a + b; });
}

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles where each pair has a thread of its own: every pair is computed once, then each particle
/// sums its pairs in the order of PairKernel, so that the two differ by no more than the rounding of a pair.
#pragma once

#include <cstdint>
#include <type_traits>

#include "contact/Meeting.hpp"
#include "exec/Single.hpp"
#include "particles/ParticleState.hpp"
#include "search/NeighborList.hpp"

namespace gimdem
{

/// What these kernels see of the list of pairs.
struct PairwiseView
{
    std::int32_t const* first;
    std::int32_t const* second;
    std::int32_t const* row_offsets;     ///< pairs in which a particle is first
    std::int32_t const* second_offsets;  ///< pairs in which it is second ...
    std::int32_t const* second_pairs;    ///< ... are second_pairs[second_offsets[i]] ..., rising
    std::int32_t const* own_seconds;     ///< where in them those with a first of its own block begin
    Quad* displacement;
    Quad* rolling_spring;  ///< null where no law has such a spring
    std::uint8_t* touches;
};

/// Four numbers of the precision of a Real.
struct alignas(16) SingleQuad
{
    float x, y, z, w;
};
template <class Real>
using QuadOf = std::conditional_t<exec::is_single<Real>, SingleQuad, Quad>;

/// What a touching pair does.
template <class Real>
struct PairForce
{
    QuadOf<Real> force;  ///< on the first [N]; w: lever of the first [m]
    QuadOf<Real> turn;   ///< tangential force x normal [N]; w: lever of the second [m]
};

/// Force of pair k; its springs go one step on. Real: double, or exec::Single for the law alone, theory.md (D.91);
/// springs are double.
template <class Law, class Space, class Real>
struct PairForceKernel
{
    ParticleView particles;
    PairwiseView list;
    typename Law::template Constants<Real> const* constants;
    std::int32_t material_count;
    double dt;
    Space space;
    PairForce<Real>* pair_force;
    Quad* rolling_torque;  ///< on the first [N m]; null where the law has none

    GIMDEM_HD void operator()(std::int64_t k) const
    {
        std::int32_t const i = list.first[k], j = list.second[k];
        bool const touching = touch(particles.position[i], particles.position[j]);
        if (!touching && list.touches[k] != 0)
        {
            list.displacement[k] = {0, 0, 0, 0};
            if constexpr (Law::has_rolling_spring) list.rolling_spring[k] = {0, 0, 0, 0};
        }
        list.touches[k] = touching;
        if (touching) compute(k, i, j);
    }

private:
    GIMDEM_HD bool touch(Quad const& a, Quad const& b) const
    {
        double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
        space.shorten(dx, dy, dz);
        double const reach = a.w + b.w;
        return reach * reach > dx * dx + dy * dy + dz * dz;
    }

    GIMDEM_HD void compute(std::int64_t k, std::int32_t i, std::int32_t j) const
    {
        MovingSphere<double> const a = sphere(i), b = sphere(j);
        ContactGeometry<Real> const contact = meet<Law, false>(encounter_in<Real>(a, b, space));
        ContactSprings<Real> springs{spring(list.displacement[k])};
        if constexpr (Law::has_rolling_spring) springs.rolling = spring(list.rolling_spring[k]);
        ContactForce<Real> const result = Law::template apply<Real>(
            constants[particles.material[i] * material_count + particles.material[j]], dt, contact, springs);
        list.displacement[k] = stored(springs.tangential);
        if constexpr (Law::has_rolling_spring) list.rolling_spring[k] = stored(springs.rolling);
        Real const half = contact.overlap / 2;
        pair_force[k] = {record(result.force, Real(a.radius) - half),
                         record(result.tangential.cross(contact.normal), Real(b.radius) - half)};
        if constexpr (Law::rolls) rolling_torque[k] = stored(result.rolling);
    }

    GIMDEM_HD static Vector3<Real> spring(Quad const& q) { return {Real(q.x), Real(q.y), Real(q.z)}; }
    GIMDEM_HD static Quad stored(Vector3<Real> const& v) { return {double(v.x), double(v.y), double(v.z), 0}; }
    GIMDEM_HD static QuadOf<Real> record(Vector3<Real> const& v, Real const& lever)
    {
        if constexpr (exec::is_single<Real>)
            return {v.x.value, v.y.value, v.z.value, lever.value};
        else
            return {v.x, v.y, v.z, lever};
    }

    GIMDEM_HD MovingSphere<double> sphere(std::int32_t i) const
    {
        Quad const x = particles.position[i], v = particles.velocity[i], w = particles.angular_velocity[i];
        return {vector3(x.xyz()), vector3(v.xyz()), vector3(w.xyz()), x.w, v.w, w.w};
    }
};

/// Finds where, among the pairs in which a particle is second, those with a first of its own block begin.
struct OwnSeconds
{
    std::int32_t const* first;
    std::int32_t const* second_offsets;
    std::int32_t const* second_pairs;
    std::int32_t* own_seconds;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        std::int64_t const block_begin = i / NeighborList::block * NeighborList::block;
        std::int32_t own = second_offsets[i];
        while (own < second_offsets[i + 1] && first[second_pairs[own]] < block_begin)
            ++own;
        own_seconds[i] = own;
    }
};

/// Sets force and torque of particle i to the sum over its pairs: first those with particles before it in its block,
/// then those with particles after it, then those with particles of earlier blocks; last, the walls.
template <class Real, class WallForces>
struct ContactSumKernel
{
    ParticleView particles;
    PairwiseView list;
    PairForce<Real> const* pair_force;
    Quad const* rolling_torque;  ///< null where the law has none
    WallForces walls;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        Sum sum{{0, 0, 0, 0}, {0, 0, 0, 0}};
        std::int32_t const own = list.own_seconds[i];
        add_seconds(own, list.second_offsets[i + 1], sum);
        for (std::int32_t k = list.row_offsets[i]; k < list.row_offsets[i + 1]; ++k)
            if (list.touches[k] != 0) add_first(k, sum);
        add_seconds(list.second_offsets[i], own, sum);
        walls.add_to(i, sum.force, sum.torque);
        particles.force[i] = sum.force;
        particles.torque[i] = sum.torque;
    }

private:
    struct Sum
    {
        Quad force, torque;
    };

    GIMDEM_HD void add_first(std::int32_t k, Sum& sum) const
    {
        PairForce<Real> const& pair = pair_force[k];
        sum.force = sum.force + without_w(pair.force);
        Quad turn = pair.force.w * without_w(pair.turn);
        if (rolling_torque != nullptr) turn = turn + rolling_torque[k];
        sum.torque = sum.torque + turn;
    }

    GIMDEM_HD void add_seconds(std::int32_t begin, std::int32_t end, Sum& sum) const
    {
        for (std::int32_t m = begin; m < end; ++m)
        {
            std::int32_t const k = list.second_pairs[m];
            if (list.touches[k] == 0) continue;
            PairForce<Real> const& pair = pair_force[k];
            sum.force = sum.force - without_w(pair.force);
            Quad turn = pair.turn.w * without_w(pair.turn);
            if (rolling_torque != nullptr) turn = turn - rolling_torque[k];
            sum.torque = sum.torque + turn;
        }
    }

    GIMDEM_HD static Quad without_w(QuadOf<Real> const& q) { return {q.x, q.y, q.z, 0}; }
};

}  // namespace gimdem

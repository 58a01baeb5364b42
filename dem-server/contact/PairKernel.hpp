// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles, one block of the neighbour list at a time.
///
/// Particles are worked on in blocks of fixed size, whatever the number of threads. A block adds the forces of its own
/// pairs straight to its own particles; what a pair does to a particle of a later block waits in a slot of the border,
/// and is fetched from there once all blocks are done. So every sum has one order.
#pragma once

#include <cstdint>

#include "contact/ContactModel.hpp"
#include "contact/Meeting.hpp"
#include "exec/Octet.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "search/Domain.hpp"
#include "search/NeighborList.hpp"

namespace gimdem
{

/// What a touching pair across a border does to its second particle: one line of the cache.
struct alignas(64) BorderForce
{
    Quad force;   ///< [N]
    Quad torque;  ///< [N m]
};

/// Numbers of pairs that touch, picked from the list until there are enough to be worth a visit.
struct TouchingPairs
{
    static constexpr int most = 256;

    int count = 0;
    std::int32_t pair[most + 2 * exec::octet];

    bool is_full() const { return count >= most; }
    /// Fills the last octet with copies of the last pair.
    void pad()
    {
        for (int n = count; n % exec::octet != 0; ++n)
            pair[n] = pair[count - 1];
    }
};

/// Where eight particles are, and how they move.
struct OctetOfParticles : MovingSphere<exec::Octet>
{
    OctetOfParticles(ParticleView const& particles, std::int32_t const* which)
    {
        auto const x = exec::load(particles.position, which);
        auto const v = exec::load(particles.velocity, which);
        auto const w = exec::load(particles.angular_velocity, which);
        position = {x.x, x.y, x.z};
        velocity = {v.x, v.y, v.z};
        spin = {w.x, w.y, w.z};
        radius = x.w;
        inverse_mass = v.w;
        inverse_inertia = w.w;
    }
};

/// Sets force and torque of a block's particles to the sum over its pairs, and advances the springs.
template <class Law, bool one_material, bool one_size, class Space>
struct PairKernel
{
    using Octet = exec::Octet;

    ParticleView particles;
    NeighborListView list;
    typename Law::template Constants<double> const* constants;
    std::int32_t material_count;
    double dt;
    BorderForce* border;
    Space space;

    void operator()(std::int64_t b) const
    {
        std::int64_t const begin = b * NeighborList::block;
        std::int64_t const last = begin + NeighborList::block;
        std::int64_t const end = last < particles.count ? last : particles.count;
        for (std::int64_t i = begin; i < end; ++i)
            particles.force[i] = particles.torque[i] = {0, 0, 0, 0};

        TouchingPairs found;
        std::int32_t const last_pair = list.row_offsets[end];
        for (std::int32_t k = list.row_offsets[begin]; k < last_pair; k += exec::octet)
        {
            look(k, last_pair - k, found);
            if (found.is_full()) compute(found);
        }
        compute(found);
    }

private:
    /// Picks those that touch from the pairs k, k + 1, ... of which there are `left`.
    GIMDEM_FLATTEN void look(std::int32_t k, std::int32_t left, TouchingPairs& found) const
    {
        int const count = left < exec::octet ? left : exec::octet;
        std::int32_t i[exec::octet], j[exec::octet];
        for (int n = 0; n < exec::octet; ++n)
        {
            std::int32_t const pair = n < count ? k + n : k;
            i[n] = list.first[pair];
            j[n] = list.second[pair];
        }
        auto const a = exec::load(particles.position, i), b = exec::load(particles.position, j);
        Octet dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
        space.shorten(dx, dy, dz);
        Octet const reach = a.w + b.w;
        exec::OctetMask const touching = exec::greater(reach * reach, dx * dx + dy * dy + dz * dz);
        for (int n = 0; n < count; ++n)
        {
            auto const now = static_cast<std::uint8_t>(touching.lanes[n] != 0);
            if (list.touches[k + n] > now)
            {
                list.displacement[k + n] = {0, 0, 0, 0};
                if constexpr (Law::has_rolling_spring) list.rolling_spring[k + n] = {0, 0, 0, 0};
            }
            list.touches[k + n] = now;
            found.pair[found.count] = k + n;
            found.count += now;
        }
    }

    void compute(TouchingPairs& found) const
    {
        found.pad();
        for (int n = 0; n < found.count; n += exec::octet)
            compute(found.pair + n, found.count - n < exec::octet ? found.count - n : exec::octet);
        found.count = 0;
    }

    /// Works on `count` pairs, at most eight.
    GIMDEM_FLATTEN void compute(std::int32_t const* pair, int count) const
    {
        std::int32_t i[exec::octet], j[exec::octet];
        for (int n = 0; n < exec::octet; ++n)
        {
            i[n] = list.first[pair[n]];
            j[n] = list.second[pair[n]];
        }
        OctetOfParticles const a(particles, i), b(particles, j);
        ContactGeometry<Octet> const contact = meet<Law, one_size, Octet>(a, b, space);
        auto const old = exec::load(list.displacement, pair);
        ContactSprings<Octet> springs{{old.x, old.y, old.z}};
        if constexpr (Law::has_rolling_spring)
        {
            auto const rolled = exec::load(list.rolling_spring, pair);
            springs.rolling = {rolled.x, rolled.y, rolled.z};
        }
        ContactForce<Octet> const result = apply_law(contact, i, j, springs);
        store(springs.tangential, list.displacement, pair);
        if constexpr (Law::has_rolling_spring) store(springs.rolling, list.rolling_spring, pair);

        Vector3<Octet> const turn = result.tangential.cross(contact.normal);
        Vector3<Octet> turn_a = Octet(a.radius - contact.overlap / 2) * turn;
        if constexpr (Law::rolls) turn_a = turn_a + result.rolling;
        Quad force[exec::octet], torque_a[exec::octet], torque_b[exec::octet];
        exec::store({result.force.x, result.force.y, result.force.z, Octet::Zero()}, force);
        exec::store({turn_a.x, turn_a.y, turn_a.z, Octet::Zero()}, torque_a);
        if constexpr (!one_size)
        {
            Vector3<Octet> turn_b = Octet(b.radius - contact.overlap / 2) * turn;
            if constexpr (Law::rolls) turn_b = turn_b - result.rolling;
            exec::store({turn_b.x, turn_b.y, turn_b.z, Octet::Zero()}, torque_b);
        }
        for (int n = 0; n < count; ++n)
        {
            particles.force[i[n]] = particles.force[i[n]] + force[n];
            particles.torque[i[n]] = particles.torque[i[n]] + torque_a[n];
            give(list.border_slot[pair[n]], j[n], force[n], one_size ? torque_a[n] : torque_b[n]);
        }
    }

    void give(std::int32_t slot, std::int32_t j, Quad const& force, Quad const& torque) const
    {
        if (slot < 0)
        {
            particles.force[j] = particles.force[j] - force;
            particles.torque[j] = particles.torque[j] + torque;
        }
        else
            border[slot] = {{-force.x, -force.y, -force.z, 0}, torque};
    }

    static void store(Vector3<Octet> const& from, Quad* values, std::int32_t const* place)
    {
        exec::store({from.x, from.y, from.z, Octet::Zero()}, values, place);
    }

    ContactForce<Octet> apply_law(ContactGeometry<Octet> const& contact, std::int32_t const* i, std::int32_t const* j,
                                  ContactSprings<Octet>& springs) const
    {
        if constexpr (one_material)
            return Law::template apply<Octet>(constants[0], dt, contact, springs);
        else
        {
            std::int32_t row[exec::octet];
            for (int n = 0; n < exec::octet; ++n)
                row[n] = particles.material[i[n]] * material_count + particles.material[j[n]];
            return Law::template apply<Octet>(octet_of<Law>(constants, row), dt, contact, springs);
        }
    }
};

/// Adds to particle i what the pairs of earlier blocks do to it.
struct BorderKernel
{
    ParticleView particles;
    NeighborListView list;
    BorderForce const* border;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        for (std::int32_t m = list.border_offsets[i]; m < list.border_offsets[i + 1]; ++m)
        {
            std::int32_t const pair = list.border_pairs[m];
            if (list.touches[pair] == 0) continue;
            BorderForce const& from = border[list.border_slot[pair]];
            particles.force[i] = particles.force[i] + from.force;
            particles.torque[i] = particles.torque[i] + from.torque;
        }
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles, one block of the neighbour list at a time.
///
/// Particles are worked on in blocks of fixed size, whatever the number of threads. A block adds the forces of its own
/// pairs straight to its own particles; what a pair does to a particle of a later block waits in a slot of the border,
/// and is fetched from there once all blocks are done. So every sum has one order.
#pragma once

#include <bit>
#include <cstdint>

#include "contact/ContactBatch.hpp"
#include "contact/ContactModel.hpp"
#include "contact/Meeting.hpp"
#include "exec/Octet.hpp"
#include "exec/Selection.hpp"
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
    using Four = exec::detail::Four;
    using Batch = ContactBatch<Law, one_size, Octet>;

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

        Batch found;
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
    GIMDEM_FLATTEN void look(std::int32_t k, std::int32_t left, Batch& found) const
    {
        if (left >= exec::octet) return look(k, list.first + k, list.second + k, list.touches + k, exec::octet, found);
        std::int32_t i[exec::octet], j[exec::octet];
        std::uint8_t touches[exec::octet];
        for (int n = 0; n < exec::octet; ++n)
        {
            std::int32_t const pair = n < left ? k + n : k;
            i[n] = list.first[pair];
            j[n] = list.second[pair];
            touches[n] = list.touches[pair];
        }
        look(k, i, j, touches, left, found);
        for (int n = 0; n < left; ++n)
            list.touches[k + n] = touches[n];
    }

    void look(std::int32_t k, std::int32_t const* i, std::int32_t const* j, std::uint8_t* touches, int count,
              Batch& found) const
    {
        auto const apart = exec::load_difference(particles.position, i, j);
        Vector3<Octet> between{apart.x, apart.y, apart.z};
        space.shorten(between.x, between.y, between.z);
        Octet const reach = apart.w, square = between.dot(between);
        exec::LaneBits const now = exec::greater_lanes(reach * reach, square) & ((1u << count) - 1);
        auto const flags = exec::EightFlags::of(now);
        if ((exec::EightFlags::load(touches).bytes & ~flags.bytes) != 0) part(k, count, touches, flags);
        flags.store(touches);

        int const at = found.count;
        exec::keep(now, between.x, found.between.x.numbers + at);
        exec::keep(now, between.y, found.between.y.numbers + at);
        exec::keep(now, between.z, found.between.z.numbers + at);
        exec::keep(now, square, found.square.numbers + at);
        exec::keep(now, i, found.first + at);
        exec::keep(now, j, found.second + at);
        std::int32_t pair[exec::octet];
        for (int n = 0; n < exec::octet; ++n)
            pair[n] = k + n;
        exec::keep(now, pair, found.pair + at);
        found.count += std::popcount(now);
    }

    /// Forgets the springs of the pairs that touch no more.
    void part(std::int32_t k, int count, std::uint8_t const* before, exec::EightFlags now) const
    {
        std::uint8_t touches[exec::octet];
        now.store(touches);
        for (int n = 0; n < count; ++n)
            if (before[n] > touches[n])
            {
                list.displacement[k + n] = {0, 0, 0, 0};
                if constexpr (Law::has_rolling_spring) list.rolling_spring[k + n] = {0, 0, 0, 0};
            }
    }

    void compute(Batch& found) const
    {
        if (found.count == 0) return;
        found.pad();
        gather(found);
        apply_law(found);
        scatter(found);
        found.count = 0;
    }

    GIMDEM_FLATTEN void gather(Batch& found) const
    {
        for (int n = 0; n < found.count; n += exec::octet)
        {
            std::int32_t const *const i = found.first + n, *const j = found.second + n;
            auto const v = exec::load_difference(particles.velocity, i, j);
            found.velocity.set(n, {v.x, v.y, v.z});
            if constexpr (one_size && !Law::rolls)
            {
                auto const w = exec::load_sum(particles.angular_velocity, i, j);
                found.spin_a.set(n, {w.x, w.y, w.z});
            }
            else
            {
                auto const wa = exec::load(particles.angular_velocity, i);
                auto const wb = exec::load(particles.angular_velocity, j);
                found.spin_a.set(n, {wa.x, wa.y, wa.z});
                found.spin_b.set(n, {wb.x, wb.y, wb.z});
                if constexpr (Law::rolls) found.inverse_inertia.set(n, wa.w + wb.w);
            }
            if constexpr (!one_size)
            {
                Octet a, b;
                for (int lane = 0; lane < exec::octet; ++lane)
                {
                    a[lane] = particles.position[i[lane]].w;
                    b[lane] = particles.position[j[lane]].w;
                }
                found.radius_a.set(n, a);
                found.radius_b.set(n, b);
                found.inverse_mass.set(n, v.w);
            }
            auto const old = exec::load(list.displacement, found.pair + n);
            found.spring.set(n, {old.x, old.y, old.z});
            if constexpr (Law::has_rolling_spring)
            {
                auto const rolled = exec::load(list.rolling_spring, found.pair + n);
                found.rolling_spring.set(n, {rolled.x, rolled.y, rolled.z});
            }
        }
    }

    GIMDEM_FLATTEN void apply_law(Batch& found) const
    {
        for (int n = 0; n < found.count; n += exec::octet)
        {
            Encounter<Octet> met{.between = found.between.at(n),
                                 .square = found.square.at(n),
                                 .velocity = found.velocity.at(n),
                                 .spin_a = found.spin_a.at(n),
                                 .spin_b = found.spin_b.at(n),
                                 .radius_a = {},
                                 .radius_b = {},
                                 .inverse_mass = {},
                                 .inverse_inertia = {}};
            if constexpr (one_size)
            {
                met.radius_a = met.radius_b = Octet::Constant(particles.position[0].w);
                met.inverse_mass = Octet::Constant(2 * particles.velocity[0].w);
            }
            else
            {
                met.radius_a = found.radius_a.at(n);
                met.radius_b = found.radius_b.at(n);
                met.inverse_mass = found.inverse_mass.at(n);
            }
            if constexpr (Law::rolls) met.inverse_inertia = found.inverse_inertia.at(n);
            ContactGeometry<Octet> const contact = meet<Law, one_size>(met);
            ContactSprings<Octet> springs{found.spring.at(n)};
            if constexpr (Law::has_rolling_spring) springs.rolling = found.rolling_spring.at(n);
            ContactForce<Octet> const result = apply_law(contact, found.first + n, found.second + n, springs);
            found.spring.set(n, springs.tangential);
            if constexpr (Law::has_rolling_spring) found.rolling_spring.set(n, springs.rolling);

            Octet const half = contact.overlap / 2;
            Vector3<Octet> const turn = result.tangential.cross(contact.normal);
            Vector3<Octet> turn_a = Octet(met.radius_a - half) * turn;
            if constexpr (Law::rolls) turn_a = turn_a + result.rolling;
            found.velocity.set(n, result.force);
            found.spin_a.set(n, turn_a);
            if constexpr (!one_size)
            {
                Vector3<Octet> turn_b = Octet(met.radius_b - half) * turn;
                if constexpr (Law::rolls) turn_b = turn_b - result.rolling;
                found.spin_b.set(n, turn_b);
            }
        }
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

    GIMDEM_FLATTEN void scatter(Batch const& found) const
    {
        int n = 0;
        for (; n + exec::octet <= found.count; n += exec::octet)
            scatter(found, n, exec::octet);
        if (n < found.count) scatter(found, n, found.count - n);
    }
    void scatter(Batch const& found, int n, int count) const
    {
        store(found.spring.at(n), list.displacement, found.pair + n);
        if constexpr (Law::has_rolling_spring)
            store(found.rolling_spring.at(n), list.rolling_spring, found.pair + n);
        Quad force[exec::octet], torque_a[exec::octet], torque_b[exec::octet];
        store(found.velocity.at(n), force);
        store(found.spin_a.at(n), torque_a);
        if constexpr (!one_size) store(found.spin_b.at(n), torque_b);
        for (int lane = 0; lane < count; ++lane)
        {
            std::int32_t const i = found.first[n + lane], j = found.second[n + lane];
            Four f, ta, tb;
            std::memcpy(&f, &force[lane], sizeof f);
            std::memcpy(&ta, &torque_a[lane], sizeof f);
            if constexpr (one_size) tb = ta; else
            std::memcpy(&tb, &torque_b[lane], sizeof f);
            add(f, particles.force[i]);
            add(ta, particles.torque[i]);
            give(list.border_slot[found.pair[n + lane]], j, -f, tb);
        }
    }
    static void store(Vector3<Octet> const& from, Quad* values)
    {
        exec::store({from.x, from.y, from.z, Octet::Constant(0)}, values);
    }
    void give(std::int32_t slot, std::int32_t j, Four const& force, Four const& torque) const
    {
        if (slot < 0)
        {
            add(force, particles.force[j]);
            add(torque, particles.torque[j]);
        }
        else
        {
            set(force, border[slot].force);
            set(torque, border[slot].torque);
        }
    }
    static exec::QuadsOfOctet quads_of(Vector3<Octet> const& from)
    {
        return exec::QuadsOfOctet::of({from.x, from.y, from.z, Octet::Constant(0)});
    }
    static void add(Four const& what, Quad& to)
    {
        Four sum;
        std::memcpy(&sum, &to, sizeof sum);
        sum += what;
        std::memcpy(&to, &sum, sizeof sum);
    }
    static void set(Four const& what, Quad& to) { std::memcpy(&to, &what, sizeof what); }

    static void store(Vector3<Octet> const& from, Quad* values, std::int32_t const* place)
    {
        exec::store({from.x, from.y, from.z, Octet::Constant(0)}, values, place);
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

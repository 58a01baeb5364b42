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
#include "contact/SpringStore.hpp"
#include "exec/Octet.hpp"
#include "particles/Materials.hpp"
#include "particles/ParticleState.hpp"
#include "search/Domain.hpp"
#include "search/NeighborList.hpp"

namespace gimdem
{

/// Pairs of one block that touch, picked from the list until there are enough to be worth a visit.
struct TouchingPairs
{
    static constexpr int most = 256;
    static constexpr int room = most + 2 * exec::octet;

    TouchingPairs(NeighborListView const& list, std::int64_t block)
        : begin(static_cast<std::int32_t>(block * NeighborList::block)),
          springs(list.pools[block]),
          border_slot(list.border_begin[block])
    {
    }

    std::int32_t const begin;  ///< first particle of the block
    SpringPool& springs;       ///< of the block
    std::int32_t border_slot;  ///< of the next pair that crosses the border
    int count = 0;
    std::int32_t first[room], second[room];
    std::int32_t border[room];      ///< slot of each pair, -1 where it stays within the block
    SpringPool::Slot spring[room];  ///< slot of each pair

    bool is_full() const { return count >= most; }
    /// Fills the last octet with copies of the last pair.
    void pad()
    {
        for (int n = count; n % exec::octet != 0; ++n)
        {
            first[n] = first[count - 1];
            second[n] = second[count - 1];
            spring[n] = spring[count - 1];
        }
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
    BorderForce* border;  ///< of the list; zero where a pair does not touch
    Space space;

    void operator()(std::int64_t b) const
    {
        std::int64_t const begin = b * NeighborList::block;
        std::int64_t const last = begin + NeighborList::block;
        std::int64_t const end = last < particles.count ? last : particles.count;
        for (std::int64_t i = begin; i < end; ++i)
            particles.force[i] = particles.torque[i] = {0, 0, 0, 0};

        TouchingPairs found(list, b);
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
            i[n] = found.begin + list.first_in_block[pair];
            j[n] = list.second[pair];
        }
        auto const a = exec::load(particles.position, i), b = exec::load(particles.position, j);
        Octet dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
        space.shorten(dx, dy, dz);
        Octet const reach = a.w + b.w;
        exec::OctetMask const touching = exec::greater(reach * reach, dx * dx + dy * dy + dz * dz);
        std::int32_t const next_block = found.begin + static_cast<std::int32_t>(NeighborList::block);
        std::int32_t border_slot = found.border_slot;
        int at = found.count;
        for (int n = 0; n < count; ++n)
        {
            bool const crosses = j[n] >= next_block;
            bool const now = touching.lanes[n] != 0;
            SpringPool::Slot slot = list.spring[k + n];
            if (now != (slot != SpringPool::none)) [[unlikely]]
                list.spring[k + n] = slot =
                    changed_touch(slot, crosses ? border + border_slot : nullptr, found.springs);
            found.first[at] = i[n];
            found.second[at] = j[n];
            found.border[at] = crosses ? border_slot : -1;
            found.spring[at] = slot;
            border_slot += crosses;
            at += slot != SpringPool::none;
        }
        found.border_slot = border_slot;
        found.count = at;
    }

    /// The slot of a pair of which a contact begins or ends: rarely, so that what looks at pairs is not burdened with
    /// it.
    [[gnu::noinline]] static SpringPool::Slot changed_touch(SpringPool::Slot slot, BorderForce* border,
                                                            SpringPool& springs)
    {
        if (slot == SpringPool::none) return springs.take();
        springs.give_back(slot);
        if (border != nullptr) *border = {{0, 0, 0}, {0, 0, 0}};
        return SpringPool::none;
    }

    void compute(TouchingPairs& found) const
    {
        found.pad();
        for (int n = 0; n < found.count; n += exec::octet)
            compute(found, n, found.count - n < exec::octet ? found.count - n : exec::octet);
        found.count = 0;
    }

    /// Works on `count` pairs from `from` on, at most eight.
    GIMDEM_FLATTEN void compute(TouchingPairs const& found, int from, int count) const
    {
        std::int32_t const *const i = found.first + from, *const j = found.second + from;
        OctetOfParticles const a(particles, i), b(particles, j);
        ContactGeometry<Octet> const contact = meet<Law, one_size, Octet>(a, b, space);
        SpringsOfOctet const stored(found.springs, found.spring + from);
        ContactSprings<Octet> springs{stored.tangential()};
        if constexpr (Law::has_rolling_spring) springs.rolling = stored.rolling();
        ContactForce<Octet> const result = apply_law(contact, i, j, springs);
        stored.set_tangential(springs.tangential);
        if constexpr (Law::has_rolling_spring) stored.set_rolling(springs.rolling);

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
            give(found.border[from + n], j[n], force[n], one_size ? torque_a[n] : torque_b[n]);
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
            border[slot] = {{-force.x, -force.y, -force.z}, {torque.x, torque.y, torque.z}};
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

/// Adds to particle i what the pairs of earlier blocks do to it: nothing, where they do not touch.
struct BorderKernel
{
    ParticleView particles;
    NeighborListView list;
    BorderForce const* border;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        for (std::int32_t m = list.border_offsets[i]; m < list.border_offsets[i + 1]; ++m)
        {
            auto const& [force, torque] = border[list.border_slots[m]];
            particles.force[i] = particles.force[i] + Quad{force.x, force.y, force.z, 0};
            particles.torque[i] = particles.torque[i] + Quad{torque.x, torque.y, torque.z, 0};
        }
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Forces between particles, one block of the neighbour list at a time.
///
/// Particles are worked on in blocks of fixed size, whatever the number of threads. A block adds the forces of its own
/// pairs straight to its own particles; what a pair does to a particle of a later block waits in a slot of the border,
/// and is fetched from there once all blocks are done. So every sum has one order.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

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
/// Real: exec::Octet, or exec::Hexadecad for laws in single precision; what is stored is double.
template <class Law, bool one_material, bool one_size, class Space, class Real = exec::Octet>
struct PairKernel
{
    using Octet = exec::Octet;
    using Four = exec::detail::Four;
    using Batch = ContactBatch<Law, one_size, Real>;

    ParticleView particles;
    NeighborListView list;
    typename Law::template Constants<double> const* constants;
    std::int32_t material_count;
    double dt;
    Space space;

    void operator()(std::int64_t b) const
    {
        std::int64_t const begin = b * NeighborList::block;
        std::int64_t const last = begin + NeighborList::block;
        std::int64_t const end = last < particles.count ? last : particles.count;
        for (std::int64_t i = begin; i < end; ++i)
            particles.force[i] = particles.torque[i] = {0, 0, 0, 0};

        Batch found(list, b);
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
        std::int32_t i[exec::octet], j[exec::octet];
        if (left >= exec::octet)
            for (int n = 0; n < exec::octet; ++n)
            {
                i[n] = found.begin + list.first_in_block[k + n];
                j[n] = list.second[k + n];
            }
        else
            for (int n = 0; n < exec::octet; ++n)
            {
                std::int32_t const pair = n < left ? k + n : k;
                i[n] = found.begin + list.first_in_block[pair];
                j[n] = list.second[pair];
            }
        look(k, i, j, left < exec::octet ? left : exec::octet, found);
    }

    void look(std::int32_t k, std::int32_t const* i, std::int32_t const* j, int count, Batch& found) const
    {
        auto const apart = exec::load_difference(particles.position, i, j);
        Vector3<Octet> between{apart.x, apart.y, apart.z};
        space.shorten(between.x, between.y, between.z);
        Octet const square = between.dot(between);
        Octet const closeness = exec::minus_product(Octet(-square), apart.w, Octet(-apart.w));
        exec::LaneBits const valid = (1u << count) - 1;
        exec::LaneBits const near = exec::greater_lanes(closeness, Octet::Constant(0)) & valid;
        exec::LaneBits const crosses = exec::at_least_lanes(j, found.begin + int(NeighborList::block)) & valid;
        std::int32_t border[exec::octet], slot[exec::octet];
        exec::number(crosses, found.next_border, border);
        exec::LaneBits const touching = spring_slots(k, count, near, border, found.springs, slot);

        int const at = found.count;
        exec::keep(touching, between.x, found.between.x.numbers + at);
        exec::keep(touching, between.y, found.between.y.numbers + at);
        exec::keep(touching, between.z, found.between.z.numbers + at);
        exec::keep(touching, square, found.square.numbers + at);
        if constexpr (exec::is_single<Real>) exec::keep(touching, closeness, found.closeness.numbers + at);
        exec::keep(touching, i, found.first + at);
        exec::keep(touching, j, found.second + at);
        exec::keep(touching, slot, found.slot + at);
        exec::keep(touching, border, found.border + at);
        found.next_border += std::popcount(crosses);
        found.count += std::popcount(touching);
    }

    /// Sees to it that those of the pairs from k on that are near have springs, and that the others have none. Returns
    /// which have, and where.
    exec::LaneBits spring_slots(std::int32_t k, int count, exec::LaneBits near, std::int32_t const* border,
                                SpringPool& springs, std::int32_t* slot) const
    {
        SpringPool::Slot slots[exec::octet];
        auto const read = [&]
        {
            for (int n = 0; n < exec::octet; ++n)
                slots[n] = n < count ? list.spring[k + n] : SpringPool::none;
        };
        if (count == exec::octet)
            std::memcpy(slots, list.spring + k, sizeof slots);
        else
            read();
        exec::LaneBits touching = exec::other_lanes(slots, SpringPool::none);
        if (touching != near)
        {
            for (int n = 0; n < count; ++n)
                if (((touching ^ near) >> n & 1) != 0) change_touch(list.spring[k + n], border[n], springs);
            read();
            touching = exec::other_lanes(slots, SpringPool::none);
        }
        for (int n = 0; n < exec::octet; ++n)
            slot[n] = slots[n];
        return touching;
    }

    /// A contact begins or ends: rarely, so that what looks at pairs is not burdened with it.
    [[gnu::noinline]] void change_touch(SpringPool::Slot& slot, std::int32_t border, SpringPool& springs) const
    {
        if (slot == SpringPool::none)
        {
            slot = springs.take();
            return;
        }
        springs.give_back(slot);
        slot = SpringPool::none;
        if (border >= 0) list.border_force[border] = {{0, 0, 0}, {0, 0, 0}};
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
            found.velocity.store_eight(n, v);
            if constexpr (one_size && !Law::rolls)
                found.spin_a.store_eight(n, exec::load_sum(particles.angular_velocity, i, j));
            else
            {
                auto const wa = exec::load(particles.angular_velocity, i);
                auto const wb = exec::load(particles.angular_velocity, j);
                found.spin_a.store_eight(n, wa);
                found.spin_b.store_eight(n, wb);
                if constexpr (Law::rolls) exec::store_eight(wa.w + wb.w, found.inverse_inertia.numbers + n);
            }
            if constexpr (!one_size)
            {
                for (int lane = 0; lane < exec::octet; ++lane)
                {
                    using Number = typename Real::Number;
                    found.radius_a.numbers[n + lane] = static_cast<Number>(particles.position[i[lane]].w);
                    found.radius_b.numbers[n + lane] = static_cast<Number>(particles.position[j[lane]].w);
                }
                exec::store_eight(v.w, found.inverse_mass.numbers + n);
            }
            found.spring.store_eight(n, exec::load_threes(&found.springs.tangential()->x, found.slot + n));
            if constexpr (Law::has_rolling_spring)
                found.rolling_spring.store_eight(n, exec::load_threes(&found.springs.rolling()->x, found.slot + n));
        }
    }

    GIMDEM_FLATTEN void apply_law(Batch& found) const
    {
        auto const known = constants[0];
        double const radius = particles.position[0].w, inverse_mass = 2 * particles.velocity[0].w;
        for (int n = 0; n < found.count; n += Real::lanes)
        {
            Encounter<Real> met;
            met.between = found.between.template at<Real>(n);
            met.square = found.square.template at<Real>(n);
            met.velocity = found.velocity.template at<Real>(n);
            met.spin_a = found.spin_a.template at<Real>(n);
            if constexpr (!one_size || Law::rolls) met.spin_b = found.spin_b.template at<Real>(n);
            if constexpr (exec::is_single<Real>) met.closeness = found.closeness.template at<Real>(n);
            if constexpr (one_size)
            {
                met.radius_a = met.radius_b = Real::Constant(radius);
                met.inverse_mass = Real::Constant(inverse_mass);
            }
            else
            {
                met.radius_a = found.radius_a.template at<Real>(n);
                met.radius_b = found.radius_b.template at<Real>(n);
                met.inverse_mass = found.inverse_mass.template at<Real>(n);
            }
            if constexpr (Law::rolls) met.inverse_inertia = found.inverse_inertia.template at<Real>(n);
            ContactGeometry<Real> const contact = meet<Law, one_size>(met);
            ContactSprings<Real> springs{found.spring.template at<Real>(n)};
            if constexpr (Law::has_rolling_spring) springs.rolling = found.rolling_spring.template at<Real>(n);
            ContactForce<Real> const result = apply_law(known, contact, found.first + n, found.second + n, springs);
            found.spring.set(n, springs.tangential);
            if constexpr (Law::has_rolling_spring) found.rolling_spring.set(n, springs.rolling);

            Real const half = contact.overlap / 2;
            Vector3<Real> const turn = result.tangential.cross(contact.normal);
            Vector3<Real> turn_a = Real(met.radius_a - half) * turn;
            if constexpr (Law::rolls) turn_a = turn_a + result.rolling;
            found.velocity.set(n, result.force);
            found.spin_a.set(n, turn_a);
            if constexpr (!one_size)
            {
                Vector3<Real> turn_b = Real(met.radius_b - half) * turn;
                if constexpr (Law::rolls) turn_b = turn_b - result.rolling;
                found.spin_b.set(n, turn_b);
            }
        }
    }

    template <class Known>
    ContactForce<Real> apply_law(Known const& known, ContactGeometry<Real> const& contact, std::int32_t const* i,
                                 std::int32_t const* j, ContactSprings<Real>& springs) const
    {
        if constexpr (one_material)
            return Law::template apply<Real>(known, dt, contact, springs);
        else
        {
            std::int32_t row[Real::lanes];
            for (int n = 0; n < Real::lanes; ++n)
                row[n] = particles.material[i[n]] * material_count + particles.material[j[n]];
            return Law::template apply<Real>(lanes_of<Law, Real>(constants, row), dt, contact, springs);
        }
    }

    GIMDEM_FLATTEN void scatter(Batch& found) const
    {
        int n = 0;
        for (; n + exec::octet <= found.count; n += exec::octet)
            scatter(found, n, exec::octet);
        if (n < found.count) scatter(found, n, found.count - n);
    }
    void scatter(Batch& found, int n, int count) const
    {
        exec::store_threes(found.spring.load_eight(n), &found.springs.tangential()->x, found.slot + n);
        if constexpr (Law::has_rolling_spring)
            exec::store_threes(found.rolling_spring.load_eight(n), &found.springs.rolling()->x, found.slot + n);
        Quad force[exec::octet], torque_a[exec::octet], torque_b[exec::octet];
        exec::store(found.velocity.load_eight(n), force);
        exec::store(found.spin_a.load_eight(n), torque_a);
        if constexpr (!one_size) exec::store(found.spin_b.load_eight(n), torque_b);
        for (int lane = 0; lane < count; ++lane)
        {
            std::int32_t const i = found.first[n + lane], j = found.second[n + lane];
            particles.force[i] = particles.force[i] + force[lane];
            particles.torque[i] = particles.torque[i] + torque_a[lane];
            give(found.border[n + lane], j, force[lane], one_size ? torque_a[lane] : torque_b[lane]);
        }
    }

    void give(std::int32_t border, std::int32_t j, Quad const& force, Quad const& torque) const
    {
        if (border < 0)
        {
            particles.force[j] = particles.force[j] - force;
            particles.torque[j] = particles.torque[j] + torque;
        }
        else
            list.border_force[border] = {{-force.x, -force.y, -force.z}, {torque.x, torque.y, torque.z}};
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

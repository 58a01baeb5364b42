// SPDX-License-Identifier: BSD-3-Clause
/// Forces of walls on particles, one block of particles at a time, eight contacts together.
#pragma once

#include <cstdint>

#include "contact/ContactModel.hpp"
#include "contact/PairKernel.hpp"
#include "particles/ParticleState.hpp"
#include "walls/WallFinder.hpp"

namespace gimdem
{

/// Adds the walls' force and torque to the particles of a block, in the order of the pairs, and advances the springs.
template <class Law>
struct WallKernel
{
    using Octet = exec::Octet;

    ParticleView particles;
    WallFinder find;
    typename Law::template Constants<double> const* constants;
    double dt;

    static constexpr std::int64_t block = 512;  ///< particles

    void operator()(std::int64_t b) const
    {
        std::int32_t const* const offsets = find.pairs.offsets;
        std::int64_t const last = (b + 1) * block;
        std::int32_t const end = offsets[last < particles.count ? last : particles.count];
        std::int32_t k = offsets[b * block];
        if (k == end) return;
        WallBatch found;
        while (k < end)
        {
            if (found.is_full()) compute(found);
            std::int32_t const i = find.pairs.particle[k];
            if (find.pairs.alone[k] != 0)
                k = find.look(k, end, found);
            else
            {
                look_closely(i, found);
                k = offsets[i + 1];
            }
        }
        compute(found);
    }

private:
    /// Looks at all pairs of particle i.
    void look_closely(std::int32_t i, WallBatch& found) const
    {
        std::int32_t const begin = find.pairs.offsets[i], end = find.pairs.offsets[i + 1];
        for (std::int32_t k = begin; k < end; ++k)
            find.force[k] = {0, 0, 0, 0};
        Touch at_hand[WallTouches::most_at_hand];
        std::int32_t count = 0;
        Touch const* const touches = find(particles.position[i], begin, end, at_hand, count);
        for (std::int32_t t = 0; t < count; ++t)
        {
            Touch const& touch = touches[t];
            if (!touch.counts) continue;
            if (found.is_full()) compute(found);
            int const place =
                found.add(i, touch.pair, find.pairs.row[touch.pair], Quad::of(touch.normal.vec(), touch.overlap));
            std::int32_t const body = find.nearby.walls.surfaces[touch.surface].body;
            if (!find.nearby.walls.bodies[body].moves) continue;
            WallPose const& pose = find.nearby.poses[body];
            found.velocity[place] = Quad::of(pose.velocity_at(touch.point.vec()), 0);
            found.spin[place] = Quad::of(pose.spin.vec(), 0);
            found.moves = true;
        }
    }

    void compute(WallBatch& found) const
    {
        found.pad();
        typename Law::template Constants<Octet> eight;
        std::int32_t known = -1;
        for (int n = 0; n < found.count; n += exec::octet)
        {
            std::int32_t const* const row = found.row + n;
            bool all_known = true;
            for (int lane = 0; lane < exec::octet; ++lane)
                all_known &= row[lane] == known;
            if (!all_known)
            {
                eight = lanes_of<Law, Octet>(constants, row);
                known = row[0];
                for (int lane = 1; lane < exec::octet; ++lane)
                    if (row[lane] != known) known = -1;
            }
            compute(found, n, eight);
        }
        found.count = 0;
        found.moves = false;
    }

    /// Works on the contacts from `first` on, at most eight.
    GIMDEM_FLATTEN void compute(WallBatch const& found, int first,
                                typename Law::template Constants<Octet> const& eight) const
    {
        std::int32_t const* const i = found.particle + first;
        std::int32_t const* const pair = found.pair + first;
        OctetOfParticles const a(particles, i);
        auto const at = exec::load(found.normal + first, WallFinder::in_order);
        ContactGeometry<Octet> const contact = meet(a, at, found, first);
        Quad* const displacement = find.springs.tangential;
        Quad* const rolling = find.springs.rolling;
        auto const old = exec::load(displacement, pair);
        ContactSprings<Octet> springs{{old.x, old.y, old.z}};
        if constexpr (Law::has_rolling_spring)
        {
            auto const rolled = exec::load(rolling, pair);
            springs.rolling = {rolled.x, rolled.y, rolled.z};
        }
        ContactForce<Octet> const result = Law::template apply<Octet>(eight, dt, contact, springs);
        store(springs.tangential, displacement, pair);
        if constexpr (Law::has_rolling_spring) store(springs.rolling, rolling, pair);

        Vector3<Octet> turn = Octet(a.radius - contact.overlap / 2) * result.tangential.cross(contact.normal);
        if constexpr (Law::rolls) turn = turn + result.rolling;
        Quad pushed[exec::octet], turned[exec::octet];
        exec::store({result.force.x, result.force.y, result.force.z, Octet::Constant(0)}, pushed);
        exec::store({turn.x, turn.y, turn.z, Octet::Constant(0)}, turned);
        int const count = found.count - first < exec::octet ? found.count - first : exec::octet;
        for (int n = 0; n < count; ++n)
        {
            particles.force[i[n]] = particles.force[i[n]] + pushed[n];
            particles.torque[i[n]] = particles.torque[i[n]] + turned[n];
            find.force[pair[n]] = {pushed[n].x, pushed[n].y, pushed[n].z, 1};
        }
    }

    /// A wall has no end of mass and radius.
    static ContactGeometry<Octet> meet(OctetOfParticles const& a, exec::OctetOfQuads const& at, WallBatch const& found,
                                       int first)
    {
        ContactGeometry<Octet> contact{.normal = {at.x, at.y, at.z},
                                       .overlap = at.w,
                                       .velocity = a.velocity,
                                       .radius_eff = a.radius,
                                       .mass_eff = 1 / a.inverse_mass};
        contact.velocity = contact.velocity - Octet(a.radius - at.w / 2) * a.spin.cross(contact.normal);
        if constexpr (Law::rolls)
        {
            contact.spin = a.spin;
            contact.inverse_inertia = a.inverse_inertia;
        }
        if constexpr (Law::coheres) contact.per_distance = Octet::Constant(0);
        if (!found.moves) return contact;
        auto const velocity = exec::load(found.velocity + first, WallFinder::in_order);
        contact.velocity = contact.velocity - Vector3<Octet>{velocity.x, velocity.y, velocity.z};
        if constexpr (Law::rolls)
        {
            auto const spin = exec::load(found.spin + first, WallFinder::in_order);
            contact.spin = contact.spin - Vector3<Octet>{spin.x, spin.y, spin.z};
        }
        return contact;
    }

    static void store(Vector3<Octet> const& from, Quad* values, std::int32_t const* place)
    {
        exec::store({from.x, from.y, from.z, Octet::Constant(0)}, values, place);
    }
};

}  // namespace gimdem

// SPDX-License-Identifier: BSD-3-Clause
/// Forces of walls on particles, one block of particles at a time, eight contacts together.
#pragma once

#include <cstdint>

#include "contact/ContactModel.hpp"
#include "contact/PairKernel.hpp"
#include "particles/ParticleState.hpp"
#include "walls/WallSprings.hpp"

namespace gimdem
{

/// The pairs of the list that WallContacts holds.
struct WallPairsView
{
    std::int32_t const* offsets;   ///< shape=(n_particles + 1,)
    std::int32_t const* particle;  ///< of each pair
    std::int32_t const* surface;   ///< of each pair
    std::int32_t const* row;       ///< of each pair: where its constants are in the table of materials
    std::uint8_t const* whole;     ///< of each pair
    std::uint8_t const* alone;     ///< of each pair
    Touch* places;                 ///< shape=(n_pairs,), or null where no particle has many pairs
};

/// Contacts that were found, until there are enough to be worth a visit.
struct WallBatch
{
    static constexpr int most = 64;

    static constexpr int room = most + exec::octet;

    int count = 0;
    std::int32_t particle[room], pair[room], row[room];
    Quad normal[room];    ///< towards the particle; w: overlap [m]
    Quad velocity[room];  ///< of the wall at the contact [m/s]
    Quad spin[room];      ///< angular velocity of the wall [rad/s]
    bool moves = false;   ///< whether any wall of the batch does

    /// There is always room for one octet more.
    bool is_full() const { return count >= most; }
    int add(std::int32_t i, std::int32_t k, std::int32_t r, Quad const& at)
    {
        particle[count] = i;
        pair[count] = k;
        row[count] = r;
        normal[count] = at;
        velocity[count] = spin[count] = {0, 0, 0, 0};
        return count++;
    }
    /// Fills the last octet with copies of the last contact.
    void pad()
    {
        for (int n = count; n % exec::octet != 0; ++n)
        {
            particle[n] = particle[count - 1];
            pair[n] = pair[count - 1];
            row[n] = row[count - 1];
            normal[n] = normal[count - 1];
            velocity[n] = velocity[count - 1];
            spin[n] = spin[count - 1];
        }
    }
};

/// The contacts of a particle near walls of any kind, and what becomes of their springs.
struct WallFinder
{
    NearbyWalls nearby;
    WallPairsView pairs;
    WallSprings springs;
    Quad const* position;
    Quad* force;  ///< of each pair [N]; w: 1 where it touches

    /// Finds the touches of pairs [begin, end) of a particle at x, its radius x.w; returns where they are: `at_hand`,
    /// or the places of a particle with many.
    GIMDEM_HD Touch const* operator()(Quad const& x, std::int32_t begin, std::int32_t end, Touch* at_hand,
                                      std::int32_t& count) const
    {
        Touch* const touches = end - begin > WallTouches::most_at_hand ? pairs.places + begin : at_hand;
        WallTouches const walls{nearby, pairs.surface, pairs.whole};
        count = walls.find(x, begin, end, touches);
        walls.weed(x.w, touches, count);
        SpringMover{walls, springs, begin, end}(touches, count);
        return touches;
    }

    /// Looks at pairs from k on of which each can be told by itself, at most eight; returns the next.
    GIMDEM_FLATTEN std::int32_t look(std::int32_t k, std::int32_t end, WallBatch& found) const
    {
        int count = 1;
        while (count < exec::octet && k + count < end && pairs.alone[k + count] != 0)
            ++count;
        std::int32_t i[exec::octet];
        Quad wall[exec::octet];
        for (int n = 0; n < exec::octet; ++n)
        {
            std::int32_t const pair = n < count ? k + n : k;
            i[n] = pairs.particle[pair];
            wall[n] = nearby.walls.surfaces[pairs.surface[pair]].normal;
        }
        auto const x = exec::load(position, i);
        auto const plane = exec::load(wall, in_order);
        exec::Octet const overlap = x.w - (plane.x * x.x + plane.y * x.y + plane.z * x.z - plane.w);
        exec::OctetMask const touching = exec::greater(overlap, exec::Octet::Constant(0));
        for (int n = 0; n < count; ++n)
        {
            if (touching.lanes[n] != 0)
            {
                Quad const& to = wall[n];
                found.add(i[n], k + n, pairs.row[k + n], {to.x, to.y, to.z, overlap[n]});
                continue;
            }
            if (force[k + n].w == 0) continue;
            springs.drop(k + n);
            force[k + n] = {0, 0, 0, 0};
        }
        return k + count;
    }

    static constexpr std::int32_t in_order[exec::octet] = {0, 1, 2, 3, 4, 5, 6, 7};
};

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

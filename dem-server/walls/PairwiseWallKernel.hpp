// SPDX-License-Identifier: BSD-3-Clause
/// Forces of the walls on particles where each particle has a thread of its own, theory.md (D.50)-(D.55).
#pragma once

#include <cstdint>

#include "contact/ContactLaws.hpp"
#include "particles/ParticleState.hpp"
#include "walls/WallSprings.hpp"

namespace gimdem
{

/// What all wall kernels share: finds the contacts of one particle, each with its springs.
struct ParticleWallFinder
{
    WallTouches walls;
    WallSprings springs;
    Quad const* position;
    std::int32_t const* offsets;
    Touch* places;  ///< shape=(n_pairs,), or null where no particle has many pairs

    /// The touches of particle i, in `at_hand` or in its places; returns where they are and how many.
    GIMDEM_HD Touch* operator()(std::int64_t i, Touch* at_hand, std::int32_t& count) const
    {
        std::int32_t const begin = offsets[i], end = offsets[i + 1];
        Touch* const touches = end - begin > WallTouches::most_at_hand ? places + begin : at_hand;
        Quad const x = position[i];
        count = walls.find(x, begin, end, touches);
        walls.weed(x.w, touches, count);
        SpringMover{walls, springs, begin, end}(touches, count);
        return touches;
    }
};

/// What the walls do to a particle.
struct WallForce
{
    Quad force;   ///< [N]; w: how many contacts
    Quad torque;  ///< [N m]
};

/// All walls of one particle.
template <class Law>
struct ParticleWallKernel
{
    ParticleView particles;
    ParticleWallFinder find;
    std::int32_t const* near;                                   ///< particles that have walls nearby
    typename Law::template Constants<double> const* constants;  ///< of all pairs of materials
    std::int32_t const* first_pair;                             ///< of each body: the row of its material
    double dt;
    WallForce* wall_force;  ///< of each near particle

    GIMDEM_HD void operator()(std::int64_t n) const
    {
        std::int64_t const i = near[n];
        Touch at_hand[WallTouches::most_at_hand];
        std::int32_t count = 0;
        Touch const* const touches = find(i, at_hand, count);

        Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
        int kept = 0;
        for (std::int32_t t = 0; t < count; ++t)
        {
            if (!touches[t].counts) continue;
            add(i, touches[t], force, torque);
            ++kept;
        }
        wall_force[n] = {Quad::of(force, kept), Quad::of(torque, 0)};
    }

private:
    GIMDEM_HD void add(std::int64_t i, Touch const& touch, Vec3& force, Vec3& torque) const
    {
        NearbyWalls const& nearby = find.walls.nearby;
        Quad const v = particles.velocity[i];
        Quad const w = particles.angular_velocity[i];
        double const radius = particles.position[i].w;
        double const lever = radius - touch.overlap / 2;
        std::int32_t const body = nearby.walls.surfaces[touch.surface].body;
        Vec3 const normal = touch.normal.vec();
        Vec3 velocity = v.xyz() - lever * w.xyz().cross(normal), spin = w.xyz();
        if (nearby.walls.bodies[body].moves)
        {
            velocity -= nearby.poses[body].velocity_at(touch.point.vec());
            spin -= nearby.poses[body].spin.vec();
        }
        ContactGeometry<double> const contact{.normal = vector3(normal),
                                              .overlap = touch.overlap,
                                              .velocity = vector3(velocity),
                                              .radius_eff = radius,
                                              .mass_eff = 1 / v.w,
                                              .spin = vector3(spin),
                                              .inverse_inertia = w.w,
                                              .per_distance = 0};
        Quad& tangential = find.springs.tangential[touch.pair];
        ContactSprings<double> springs{vector3(tangential.xyz())};
        if constexpr (Law::has_rolling_spring) springs.rolling = vector3(find.springs.rolling[touch.pair].xyz());
        ContactForce<double> const result =
            Law::template apply<double>(constants[first_pair[body] + particles.material[i]], dt, contact, springs);
        tangential = Quad::of(vec3(springs.tangential), 0);
        if constexpr (Law::has_rolling_spring) find.springs.rolling[touch.pair] = Quad::of(vec3(springs.rolling), 0);
        force += vec3(result.force);
        torque -= lever * normal.cross(vec3(result.tangential));
        if constexpr (Law::rolls) torque += vec3(result.rolling);
    }
};

/// The walls' forces as the sum over all contacts of a particle wants them.
struct WallForcesView
{
    std::int32_t const* near_places;  ///< shape=(n_particles + 1,): where those of a particle are, if it has any
    WallForce const* forces;

    /// Adds what the walls do to particle i.
    GIMDEM_HD void add_to(std::int64_t i, Quad& force, Quad& torque) const
    {
        if (near_places[i] == near_places[i + 1]) return;
        WallForce const wall = forces[near_places[i]];
        if (wall.force.w == 0) return;
        force = force + Quad{wall.force.x, wall.force.y, wall.force.z, 0};
        torque = torque + wall.torque;
    }
};

}  // namespace gimdem

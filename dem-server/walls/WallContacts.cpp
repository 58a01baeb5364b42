// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallContacts.hpp"

#include "contact/HertzMindlin.hpp"
#include "exec/ForEach.hpp"

namespace gimdem
{

namespace
{

/// All walls of one particle.
struct WallKernel
{
    ParticleView particles;
    WallTouches walls;
    std::int32_t const* offsets;
    Touch* places;                      ///< shape=(n_pairs,), or null where no particle has many pairs
    ContactConstants const* constants;  ///< of all pairs of materials
    std::int32_t const* first_pair;     ///< of each body: the row of its material
    double dt;
    Quad* displacement;
    Quad* wall_force;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        wall_force[i] = {0, 0, 0, 0};
        std::int32_t const begin = offsets[i], end = offsets[i + 1];
        if (begin == end) return;
        Touch at_hand[WallTouches::most_at_hand];
        Touch* const touches = end - begin > WallTouches::most_at_hand ? places + begin : at_hand;
        Quad const x = particles.position[i];
        std::int32_t const count = walls.find(x, begin, end, touches);
        walls.weed(x.w, touches, count);
        move_springs(begin, end, touches, count);

        Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
        int kept = 0;
        for (std::int32_t t = 0; t < count; ++t)
        {
            if (!touches[t].counts) continue;
            add(i, touches[t], force, torque);
            ++kept;
        }
        particles.force[i].set_xyz(particles.force[i].xyz() + force);
        particles.torque[i].set_xyz(particles.torque[i].xyz() + torque);
        wall_force[i] = Quad::of(force, kept);
    }

private:
    /// A contact that comes over from another plane of its patch, or from the same edge, brings its spring along;
    /// planes that are no longer touched lose theirs.
    GIMDEM_HD void move_springs(std::int32_t begin, std::int32_t end, Touch const* touches, std::int32_t count) const
    {
        for (std::int32_t t = 0; t < count; ++t)
            if (touches[t].counts) displacement[touches[t].pair].w = 1;
        for (std::int32_t t = 0; t < count; ++t)
        {
            std::int32_t const k = touches[t].pair;
            if (!touches[t].counts || !displacement[k].xyz().isZero(0)) continue;
            std::int32_t const from = giver(begin, end, touches, count, t);
            if (from >= 0) displacement[k].set_xyz(displacement[from].xyz());
        }
        for (std::int32_t k = begin; k < end; ++k)
            if (displacement[k].w == 0)
                displacement[k] = {0, 0, 0, 0};
            else
                displacement[k].w = 0;
    }

    /// Pair whose spring touch t takes over: one that touches no more, most nearly in the same plane; or -1.
    GIMDEM_HD std::int32_t giver(std::int32_t begin, std::int32_t end, Touch const* touches, std::int32_t count,
                                 std::int32_t t) const
    {
        WallSurface const* const surfaces = walls.nearby.walls.surfaces;
        WallSurface const& own = surfaces[touches[t].surface];
        std::int32_t best = -1;
        double best_cosine = 0.5;  // two smooth seams at most lie between
        for (std::int32_t k = begin; k < end; ++k)
        {
            if (displacement[k].w != 0 || displacement[k].xyz().isZero(0)) continue;
            WallSurface const& other = surfaces[walls.plane[k]];
            double cosine = own.normal.xyz().dot(other.normal.xyz());
            if (own.two_sided) cosine = std::abs(cosine);
            if (other.patch != own.patch) cosine = shares_point(touches, count, t, k) ? 1 : 0;
            if (cosine <= best_cosine) continue;
            best = k;
            best_cosine = cosine;
        }
        return best;
    }

    /// Whether pair k touches the particle too, as a part of touch t.
    GIMDEM_HD bool shares_point(Touch const* touches, std::int32_t count, std::int32_t t, std::int32_t k) const
    {
        for (std::int32_t u = 0; u < count; ++u)
            if (touches[u].pair == k)
                return (touches[u].point.vec() - touches[t].point.vec()).norm() <= 1e-3 * touches[t].overlap;
        return false;
    }

    GIMDEM_HD void add(std::int64_t i, Touch const& touch, Vec3& force, Vec3& torque) const
    {
        Quad const v = particles.velocity[i];
        double const radius = particles.position[i].w;
        double const lever = radius - touch.overlap / 2;
        std::int32_t const body = walls.nearby.walls.surfaces[touch.surface].body;
        Vec3 const normal = touch.normal.vec();
        Vec3 velocity = v.xyz() - lever * particles.angular_velocity[i].xyz().cross(normal);
        if (walls.nearby.walls.bodies[body].moves) velocity -= walls.nearby.poses[body].velocity_at(touch.point.vec());
        ContactGeometry<double> const contact{.normal = vector3(normal),
                                              .overlap = touch.overlap,
                                              .velocity = vector3(velocity),
                                              .radius_eff = radius,
                                              .mass_eff = 1 / v.w};
        HertzMindlin<double> const law{constants[first_pair[body] + particles.material[i]], dt};
        Vector3<double> spring = vector3(displacement[touch.pair].xyz());
        ContactForce<double> const result = law(contact, spring);
        displacement[touch.pair] = {spring.x, spring.y, spring.z, 0};
        force += vec3(result.force);
        torque -= lever * normal.cross(vec3(result.tangential));
    }
};

}  // namespace

WallContacts::WallContacts(exec::Execution execution, Materials const& materials, int wall_material,
                           WallGeometry const& walls)
    : execution_(execution), constants_(materials.table()), walls_(walls)
{
    poses_.resize(walls.body_count());
    first_pair_.resize(walls.body_count());
    for (std::int32_t b = 0; b < walls.body_count(); ++b)
    {
        std::string const& name = walls.material(b);
        first_pair_[b] = (name.empty() ? wall_material : materials.number_of(name)) * materials.count();
        poses_[b] = walls.motion(b).at(0);
        some_wall_moves_ |= walls.motion(b).moves();
    }
}

void WallContacts::add_forces(ParticleState& particles, double dt)
{
    wall_force_.resize(particles.count());
    exec::for_each(execution_, particles.count(),
                   WallKernel{particles.view(),
                              {nearby(), pairs_.plane.view().data, pairs_.whole.view().data},
                              pairs_.offsets.view().data,
                              touches_.view().data,
                              constants_.data,
                              first_pair_.view().data,
                              dt,
                              pairs_.displacement.view().data,
                              wall_force_.view().data});
}

}  // namespace gimdem
